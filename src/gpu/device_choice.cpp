#include "gpu/device_choice.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "base/error.h"

namespace importon::gpu {
namespace {

constexpr const char* kListDevices = "`importon devices` lists them";

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// devices.size() if no device is meant.
std::size_t findDevice(std::span<const DeviceInfo> devices, const std::string& wanted) {
  std::size_t index = 0;
  const auto [end, failure] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  if (failure == std::errc{} && end == wanted.data() + wanted.size()) return std::min(index, devices.size());
  const std::string part = lowerCase(wanted);
  const auto isMeant = [&part](const DeviceInfo& device) {
    return lowerCase(device.name).find(part) != std::string::npos;
  };
  const auto isMeantAndUsable = [&](const DeviceInfo& device) { return isMeant(device) && device.missing.empty(); };
  auto found = std::find_if(devices.begin(), devices.end(), isMeantAndUsable);
  if (found == devices.end()) found = std::find_if(devices.begin(), devices.end(), isMeant);
  return static_cast<std::size_t>(found - devices.begin());
}

}  // namespace

std::size_t defaultDevice(std::span<const DeviceInfo> devices) {
  for (const char* type : {"discrete", "integrated", "virtual", "cpu", "other"}) {
    for (std::size_t i = 0; i < devices.size(); ++i) {
      if (devices[i].type == type && devices[i].missing.empty()) return i;
    }
  }
  return devices.size();
}

std::size_t chooseDevice(std::span<const DeviceInfo> devices, const std::string& wanted) {
  if (wanted.empty()) {
    const std::size_t chosen = defaultDevice(devices);
    if (chosen < devices.size()) return chosen;
    if (devices.empty()) throw DeviceError("no Vulkan device was found", "", kInstallDriver);
    throw DeviceError("no Vulkan device is usable: " + devices[0].missing + " is missing", devices[0].name,
                      kInstallDriver);
  }
  const std::size_t chosen = findDevice(devices, wanted);
  if (chosen == devices.size())
    throw DeviceError("no Vulkan device is named '" + wanted + "'", "--device", kListDevices);
  if (!devices[chosen].missing.empty()) {
    throw DeviceError("the Vulkan device lacks " + devices[chosen].missing, devices[chosen].name,
                      "choose another --device; " + std::string(kListDevices));
  }
  return chosen;
}

}  // namespace importon::gpu
