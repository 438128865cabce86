/// Physical devices and what they can do.
#pragma once
#include <vulkan/vulkan.h>

#include <vector>

#include "gpu/context.h"

namespace importon::gpu {

struct PhysicalDevice {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  DeviceInfo info;
};

/// All devices, the default one marked. Throws DeviceError when there is none.
[[nodiscard]] std::vector<PhysicalDevice> physicalDevices(VkInstance instance);

}  // namespace importon::gpu
