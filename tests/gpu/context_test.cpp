#include "gpu/context.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "base/error.h"
#include "gpu/buffer.h"
#include "support/gpu_test.h"

namespace importon::gpu {
namespace {

class ContextTest : public test::GpuTest {};

TEST_F(ContextTest, DescribesItsDevice) {
  EXPECT_FALSE(context().info().name.empty());
  EXPECT_FALSE(context().info().driver.empty());
  EXPECT_FALSE(context().info().type.empty());
  EXPECT_GE(context().info().apiVersion, (1u << 22) | (2u << 12));
  EXPECT_TRUE(context().info().missing.empty());
}

TEST_F(ContextTest, LimitsMeetWhatVulkanPromises) {
  const Limits& limits = context().limits();
  EXPECT_GE(limits.maxStorageBufferRange, 1u << 27);
  EXPECT_GE(limits.maxTexelBufferElements, 1u << 16);
  EXPECT_GE(limits.maxAllocation, 1u << 30);
  EXPECT_GE(limits.maxWorkgroupCountX, 65535u);
  EXPECT_GE(limits.maxWorkgroupSize, 128u);
  EXPECT_GT(limits.heapBytes, 0u);
  EXPECT_EQ(limits.isCpu, context().info().type == "cpu");
}

TEST_F(ContextTest, ListsExactlyOneDefaultDevice) {
  int defaults = 0;
  for (const DeviceInfo& device : listDevices()) {
    if (!device.isDefault) continue;
    ++defaults;
    EXPECT_EQ(device.name, context().info().name);
  }
  EXPECT_EQ(defaults, 1);
}

TEST_F(ContextTest, OpensADeviceByIndexAndByName) {
  const auto devices = listDevices();
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (!devices[i].missing.empty()) continue;
    EXPECT_EQ(gpu::Context({.device = std::to_string(i)}).info().name, devices[i].name);
    EXPECT_EQ(gpu::Context({.device = devices[i].name.substr(0, 5)}).info().name.substr(0, 5),
              devices[i].name.substr(0, 5));
  }
}

TEST_F(ContextTest, RefusesAnUnknownDevice) { EXPECT_THROW(gpu::Context({.device = "no such device"}), DeviceError); }

TEST_F(ContextTest, CountsAllocatedBytesAndTheirPeak) {
  gpu::Context own({});
  EXPECT_EQ(own.allocatedBytes(), 0u);
  {
    const Buffer first(own, "first", 1 << 20);
    const Buffer second(own, "second", 2 << 20);
    EXPECT_GE(own.allocatedBytes(), 3u << 20);
  }
  const Buffer third(own, "third", 1 << 20);
  EXPECT_GE(own.allocatedBytes(), 1u << 20);
  EXPECT_LT(own.allocatedBytes(), 2u << 20);
  EXPECT_GE(own.peakBytes(), 3u << 20);
}

TEST_F(ContextTest, MayBeDestroyedBeforeWhatWasMadeFromIt) {
  auto own = std::make_unique<gpu::Context>(ContextOptions{});
  const std::vector<std::uint32_t> data = {1, 2, 3};
  const Buffer buffer = makeBuffer(*own, "survivor", std::span<const std::uint32_t>(data));
  own.reset();
  EXPECT_EQ(buffer.download<std::uint32_t>(3), data);
}

/// Opens a context in a child process after `variable` was set to a folder or file that is not there.
void openWithout(const char* variable, bool hasValidation) {
  setenv(variable, "/nonexistent", 1);
  try {
    const gpu::Context opened({.validation = hasValidation});
  } catch (const DeviceError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    std::exit(static_cast<int>(error.status()));
  }
  std::exit(0);
}

TEST(ContextDeathTest, NamesThePackageWhenThereIsNoDriver) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  unsetenv("VK_DRIVER_FILES");
  EXPECT_EXIT(openWithout("VK_ICD_FILENAMES", false), ::testing::ExitedWithCode(3),
              "no Vulkan driver was found.*mesa-vulkan-drivers");
}

TEST(ContextDeathTest, NamesThePackageWhenTheValidationLayerIsMissing) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(openWithout("VK_LAYER_PATH", true), ::testing::ExitedWithCode(3),
              "validation layer is missing.*vulkan-validationlayers");
}

TEST(ContextDeathTest, ListingDevicesWithoutADriverIsADeviceError) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  unsetenv("VK_DRIVER_FILES");
  const auto list = [] {
    setenv("VK_ICD_FILENAMES", "/nonexistent", 1);
    try {
      (void)listDevices();
    } catch (const DeviceError& error) {
      std::fprintf(stderr, "%s\n", error.what());
      std::exit(static_cast<int>(error.status()));
    }
    std::exit(0);
  };
  EXPECT_EXIT(list(), ::testing::ExitedWithCode(3), "mesa-vulkan-drivers");
}

}  // namespace
}  // namespace importon::gpu
