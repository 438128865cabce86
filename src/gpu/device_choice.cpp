#include "gpu/device_choice.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <sstream>

#include "base/error.h"

namespace importon::gpu {
namespace {

constexpr const char* kAllDevices = "all";
constexpr const char* kListDevices = "`importon devices` lists them";

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// devices.size() if no device is meant, or by its name none that is not among those `taken`.
std::size_t findDevice(std::span<const DeviceInfo> devices, const std::string& wanted,
                       std::span<const std::size_t> taken = {}) {
  std::size_t index = 0;
  const auto [end, failure] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  if (failure == std::errc{} && end == wanted.data() + wanted.size()) return std::min(index, devices.size());
  const std::string part = lowerCase(wanted);
  const auto isMeant = [&](const DeviceInfo& device) {
    return lowerCase(device.name).find(part) != std::string::npos &&
           std::ranges::find(taken, static_cast<std::size_t>(&device - devices.data())) == taken.end();
  };
  const auto isMeantAndUsable = [&](const DeviceInfo& device) { return isMeant(device) && device.missing.empty(); };
  auto found = std::find_if(devices.begin(), devices.end(), isMeantAndUsable);
  if (found == devices.end()) found = std::find_if(devices.begin(), devices.end(), isMeant);
  return static_cast<std::size_t>(found - devices.begin());
}

void requireUsable(const DeviceInfo& device) {
  if (device.missing.empty()) return;
  throw DeviceError("the Vulkan device lacks " + device.missing, device.name,
                    "choose another --device; " + std::string(kListDevices));
}

[[noreturn]] void refuse(const std::string& wanted) {
  throw DeviceError("no Vulkan device is named '" + wanted + "'", "--device", kListDevices);
}

std::vector<std::size_t> allLikeDefault(std::span<const DeviceInfo> devices) {
  const std::string& type = devices[chooseDevice(devices, "")].type;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < devices.size(); ++i)
    if (devices[i].type == type && devices[i].missing.empty() && !devices[i].isTwin) chosen.push_back(i);
  return chosen;
}

std::vector<std::string> partedByCommas(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text + ",");
  for (std::string part; std::getline(stream, part, ',');) {
    const std::size_t first = part.find_first_not_of(' '), last = part.find_last_not_of(' ');
    if (first == std::string::npos)
      throw DeviceError("a device has no name in '" + text + "'", "--device",
                        "give names or indices, parted by commas");
    parts.push_back(part.substr(first, last - first + 1));
  }
  return parts;
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
  if (chosen == devices.size()) refuse(wanted);
  requireUsable(devices[chosen]);
  return chosen;
}

void markTwins(std::span<DeviceInfo> devices) {
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const auto isSame = [&](const DeviceInfo& other) {
      return other.identity == devices[i].identity && other.missing.empty();
    };
    devices[i].isTwin = !devices[i].identity.empty() && std::ranges::any_of(devices.first(i), isSame);
  }
}

std::vector<std::size_t> chooseDevices(std::span<const DeviceInfo> devices, const std::string& wanted) {
  if (wanted == kAllDevices) return allLikeDefault(devices);
  if (wanted.empty() || findDevice(devices, wanted) < devices.size()) return {chooseDevice(devices, wanted)};
  std::vector<std::size_t> chosen;
  for (const std::string& part : partedByCommas(wanted)) {
    std::size_t device = findDevice(devices, part, chosen);
    if (device == devices.size()) device = findDevice(devices, part);
    if (device == devices.size()) refuse(part);
    requireUsable(devices[device]);
    if (std::ranges::find(chosen, device) != chosen.end())
      throw DeviceError("device '" + part + "' is meant twice", "--device", kListDevices);
    chosen.push_back(device);
  }
  return chosen;
}

std::vector<std::string> devicesNamed(const std::string& wanted) {
  if (wanted != kAllDevices && wanted.find(',') == std::string::npos) return {wanted};
  std::vector<std::string> names;
  for (const std::size_t device : chooseDevices(listDevices(), wanted)) names.push_back(std::to_string(device));
  return names;
}

}  // namespace importon::gpu
