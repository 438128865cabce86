#include "gpu/vulkan_error.h"

#include "base/error.h"

namespace importon::gpu {
namespace {

/// The results that the calls of this folder may fail with; the number for any other.
std::string resultName(VkResult result) {
  switch (result) {
    case VK_ERROR_INITIALIZATION_FAILED:
      return "VK_ERROR_INITIALIZATION_FAILED";
    case VK_ERROR_MEMORY_MAP_FAILED:
      return "VK_ERROR_MEMORY_MAP_FAILED";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "VK_ERROR_LAYER_NOT_PRESENT";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "VK_ERROR_EXTENSION_NOT_PRESENT";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "VK_ERROR_FEATURE_NOT_PRESENT";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "VK_ERROR_INCOMPATIBLE_DRIVER";
    case VK_ERROR_TOO_MANY_OBJECTS:
      return "VK_ERROR_TOO_MANY_OBJECTS";
    case VK_ERROR_OUT_OF_POOL_MEMORY:
      return "VK_ERROR_OUT_OF_POOL_MEMORY";
    default:
      return "VkResult " + std::to_string(static_cast<int>(result));
  }
}

}  // namespace

void throwDeviceError(VkResult result, const std::string& doing, const std::string& where) {
  switch (result) {
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      throw DeviceError("out of device memory: cannot " + doing, where,
                        "lower --memory or the image size, or choose another --device");
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      throw DeviceError("out of host memory: cannot " + doing, where, "free memory or lower the image size");
    case VK_ERROR_DEVICE_LOST:
      throw DeviceError("the device was lost: cannot " + doing, where,
                        "another program or the driver's watchdog may have reset it; try again, with fewer --photons "
                        "or another --device if it happens again");
    default:
      throw DeviceError("Vulkan call failed with " + resultName(result) + ": cannot " + doing, where,
                        "run with --validation to learn more, or choose another --device");
  }
}

void check(VkResult result, const std::string& doing, const std::string& where) {
  if (result != VK_SUCCESS) throwDeviceError(result, doing, where);
}

}  // namespace importon::gpu
