#include "gpu/vulkan_error.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace importon::gpu {
namespace {

std::string messageFor(VkResult result) {
  try {
    check(result, "run photons", "Some GPU");
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.status(), ExitStatus::device);
    return error.what();
  }
  return "";
}

TEST(VulkanError, SuccessIsNoError) { EXPECT_EQ(messageFor(VK_SUCCESS), ""); }

TEST(VulkanError, OutOfDeviceMemorySaysWhatToLower) {
  const std::string message = messageFor(VK_ERROR_OUT_OF_DEVICE_MEMORY);
  EXPECT_EQ(message.find("out of device memory: cannot run photons (Some GPU): lower --memory"), 0u) << message;
}

TEST(VulkanError, LostDeviceNamesTheDispatch) {
  const std::string message = messageFor(VK_ERROR_DEVICE_LOST);
  EXPECT_EQ(message.find("the device was lost: cannot run photons (Some GPU)"), 0u) << message;
}

TEST(VulkanError, OtherResultsAreNamed) {
  EXPECT_NE(messageFor(VK_ERROR_TOO_MANY_OBJECTS).find("VK_ERROR_TOO_MANY_OBJECTS"), std::string::npos);
  EXPECT_NE(messageFor(VK_ERROR_FRAGMENTATION).find("VkResult -1000161000"), std::string::npos);
}

}  // namespace
}  // namespace importon::gpu
