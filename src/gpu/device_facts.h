/// What is to be known of a physical device before it is opened.
#pragma once
#include <vulkan/vulkan.h>

#include <array>
#include <cstdint>
#include <optional>

#include "gpu/context.h"

namespace importon::gpu {

struct DeviceFacts {
  DeviceInfo info;
  Limits limits;
  std::uint32_t queueFamily = 0;    // the first that computes
  std::uint64_t timestampMask = 0;  // the bits of a timestamp that count; 0: the queue has no timestamps
  std::array<std::uint32_t, 3> maxWorkgroupCount{};
  VkPhysicalDeviceMemoryProperties memory{};
  bool mapsBuffers = false;  // device-local memory can be written and read by the host at full speed

  /// The type of memory among `typeBits` that has all of `needed` and most of `wanted`; none: nullopt.
  [[nodiscard]] std::optional<std::uint32_t> memoryType(std::uint32_t typeBits, VkMemoryPropertyFlags needed,
                                                        VkMemoryPropertyFlags wanted) const;
};

/// Whether the texel buffers of a device hold those of a scene.
[[nodiscard]] bool hasLargeTexelBuffers(const VkPhysicalDeviceLimits& limits);

[[nodiscard]] DeviceFacts readFacts(VkPhysicalDevice device, const DeviceInfo& info);

}  // namespace importon::gpu
