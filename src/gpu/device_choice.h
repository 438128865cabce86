/// Which of the machine's devices to use.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

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

/// Marks the devices that an earlier usable one of the same identity stands for.
void markTwins(std::span<DeviceInfo> devices);

/// Indices of the devices that --device `wanted` means: `all` for all usable ones of the default device's type but
/// twins; several in its order, parted by commas, each of them what chooseDevice() takes, where a name means the first
/// device that is not taken yet; else one. A name with a comma in it is taken for one where there is such a device.
/// Throws DeviceError where one is not there, lacks a feature or is meant twice.
[[nodiscard]] std::vector<std::size_t> chooseDevices(std::span<const DeviceInfo> devices, const std::string& wanted);

/// The same as what ContextOptions::device takes, of this machine. One device is left as it is named, and not looked
/// for.
[[nodiscard]] std::vector<std::string> devicesNamed(const std::string& wanted);

}  // namespace importon::gpu
