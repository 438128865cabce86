/// Physical devices and what they can do.
#pragma once
#include <vulkan/vulkan.h>

#include <vector>

#include "gpu/context.h"

namespace importon::gpu {

class ValidationLog;

/// An instance of Vulkan 1.2; with validation, its messages go to `log`. Throws DeviceError with a remedy when
/// there is no driver.
[[nodiscard]] VkInstance createInstance(bool hasValidation, ValidationLog& log);

struct PhysicalDevice {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  DeviceInfo info;
};

/// All devices, the default one marked. Throws DeviceError when there is none.
[[nodiscard]] std::vector<PhysicalDevice> physicalDevices(VkInstance instance);

}  // namespace importon::gpu
