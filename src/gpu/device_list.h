/// Physical devices and what they can do.
#pragma once
#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "gpu/context.h"

namespace importon::gpu {

struct PhysicalDevice {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  DeviceInfo info;
};

/// The first queue family that computes.
struct ComputeQueue {
  std::uint32_t family = 0;
  std::uint32_t timestampBits = 0;  // that count; 0: the queue has no timestamps
};
[[nodiscard]] std::optional<ComputeQueue> computeQueue(VkPhysicalDevice device);

/// All devices, the default one marked. Throws DeviceError when there is none.
[[nodiscard]] std::vector<PhysicalDevice> physicalDevices(VkInstance instance);

}  // namespace importon::gpu
