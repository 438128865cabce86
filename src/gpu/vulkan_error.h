/// Vulkan results as DeviceErrors.
#pragma once
#include <vulkan/vulkan.h>

#include <string>

namespace importon::gpu {

/// Throws DeviceError unless `result` is VK_SUCCESS. `doing` completes "cannot ..."; `where` names the device,
/// the buffer or the dispatch.
void check(VkResult result, const std::string& doing, const std::string& where);

/// Throws the DeviceError that `result`, a failure, stands for.
[[noreturn]] void throwDeviceError(VkResult result, const std::string& doing, const std::string& where);

}  // namespace importon::gpu
