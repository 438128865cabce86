/// Command pools, command buffers, fences and the barrier that stands between any two commands.
#pragma once
#include <vulkan/vulkan.h>

#include "gpu/handle.h"

namespace importon::gpu {

class Device;

[[nodiscard]] CommandPoolHandle createCommandPool(Device& device);
[[nodiscard]] VkCommandBuffer allocateCommandBuffer(Device& device, VkCommandPool pool);
[[nodiscard]] FenceHandle createFence(Device& device);

/// Begins recording for one submission; drops what was recorded before.
void beginCommands(Device& device, VkCommandBuffer commands);

/// What was recorded before is done, and its writes are seen by dispatches, indirect arguments, transfers and
/// the host, before anything recorded after starts.
void recordBarrier(VkCommandBuffer commands);

}  // namespace importon::gpu
