/// Which of the machine's devices to use.
#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "gpu/context.h"

namespace importon::gpu {

/// What to do when there is no device.
inline constexpr const char* kInstallDriver =
    "install a Vulkan driver, e.g. the package mesa-vulkan-drivers, which also runs without a GPU";

/// Index of the device that the option --device `wanted` means: an index, or a part of the name in any case
/// (usable devices first); empty: the default. Throws DeviceError if there is none such or it lacks a feature.
[[nodiscard]] std::size_t chooseDevice(std::span<const DeviceInfo> devices, const std::string& wanted);

/// Index of the first usable device of the best type there is: discrete, integrated, virtual, cpu, other;
/// devices.size() if none is usable.
[[nodiscard]] std::size_t defaultDevice(std::span<const DeviceInfo> devices);

}  // namespace importon::gpu
