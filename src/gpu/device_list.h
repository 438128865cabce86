/// Physical devices: what they can do, and which one to use.
#pragma once
#include <span>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include "gpu/context.h"

namespace importon::gpu {

/// An instance of Vulkan 1.2; with validation, its messages go to `log`. Throws DeviceError with a remedy when
/// there is no driver.
[[nodiscard]] VkInstance createInstance(bool hasValidation, class ValidationLog& log);

struct PhysicalDevice {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  DeviceInfo info;
};

/// All devices, the default one marked. Throws DeviceError when there is none.
[[nodiscard]] std::vector<PhysicalDevice> physicalDevices(VkInstance instance);

/// Index of the device that the option --device `wanted` means: an index, or a part of the name in any case;
/// empty: the default. Throws DeviceError if there is none such or it lacks a needed feature.
[[nodiscard]] std::size_t chooseDevice(std::span<const DeviceInfo> devices, const std::string& wanted);

/// Index of the first usable device of the best type there is: discrete, integrated, virtual, cpu, other;
/// devices.size() if none is usable.
[[nodiscard]] std::size_t defaultDevice(std::span<const DeviceInfo> devices);

}  // namespace importon::gpu
