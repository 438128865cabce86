#include <cstdio>

#include "app/commands.h"
#include "fmt/format.h"
#include "gpu/context.h"

namespace importon {
namespace {

/// Vulkan packs versions: 7 bits major above 10 bits minor above 12 bits patch.
std::string versionText(std::uint32_t version) {
  return fmt::format("{}.{}.{}", (version >> 22) & 0x7f, (version >> 12) & 0x3ff, version & 0xfff);
}

}  // namespace

ExitStatus runDevices() {
  const std::vector<gpu::DeviceInfo> devices = gpu::listDevices();
  if (devices.empty()) {
    throw DeviceError("no Vulkan device", "",
                      "install a driver (Debian: mesa-vulkan-drivers), or check VK_DRIVER_FILES");
  }
  std::string text;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const gpu::DeviceInfo& device = devices[i];
    text += fmt::format("{} {}: {} ({}, {}, Vulkan {}){}{}\n", device.isDefault ? '*' : ' ', i, device.name,
                        device.type, device.driver, versionText(device.apiVersion),
                        device.missing.empty() ? "" : " cannot be used, it lacks: " + device.missing,
                        device.isTwin ? " also above, by another driver" : "");
  }
  std::fputs(text.c_str(), stdout);
  return ExitStatus::ok;
}

}  // namespace importon
