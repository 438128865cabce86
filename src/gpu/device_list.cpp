#include "gpu/device_list.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

#include "base/error.h"
#include "gpu/device_choice.h"
#include "gpu/device_facts.h"
#include "gpu/instance.h"
#include "gpu/kernel_code.h"
#include "gpu/vulkan_error.h"

namespace importon::gpu {
namespace {

const char* typeName(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "cpu";
    default:
      return "other";
  }
}

/// Names of the limits that are too low for the kernel that binds most, with need and limit.
std::vector<std::string> missingLimits(const VkPhysicalDeviceLimits& given) {
  const bool hasTexels = hasLargeTexelBuffers(given);
  const std::uint32_t storage = hasTexels ? kMostDescriptors.storage : kMostDescriptors.storageAndTexels;
  const std::uint32_t texels = hasTexels ? kMostDescriptors.texels : 0;
  std::vector<std::string> missing;
  const auto need = [&missing](std::uint32_t most, std::uint32_t limit, const char* name) {
    if (limit < most) missing.push_back(std::to_string(most) + " " + name + " (it has " + std::to_string(limit) + ")");
  };
  need(storage, given.maxPerStageDescriptorStorageBuffers, "storage buffers in a kernel");
  need(texels, given.maxPerStageDescriptorSampledImages, "texel buffers in a kernel");
  need(kMostDescriptors.uniform, given.maxPerStageDescriptorUniformBuffers, "uniform buffers in a kernel");
  need(storage + texels + kMostDescriptors.uniform, given.maxPerStageResources, "buffers in a kernel");
  return missing;
}

/// Names of what our kernels need and the device does not have, comma separated.
std::string missingFeatures(VkPhysicalDevice device, const VkPhysicalDeviceProperties& properties) {
  if (properties.apiVersion < VK_API_VERSION_1_2) return "Vulkan 1.2";
  VkPhysicalDeviceVulkan12Features features12{};
  features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  VkPhysicalDeviceFeatures2 features{};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  features.pNext = &features12;
  vkGetPhysicalDeviceFeatures2(device, &features);
  std::string missing;
  const auto need = [&missing](bool has, const std::string& name) {
    if (!has) missing += (missing.empty() ? "" : ", ") + name;
  };
  need(features12.scalarBlockLayout == VK_TRUE, "scalarBlockLayout");
  need(computeQueue(device).has_value(), "compute queue");
  for (const std::string& limit : missingLimits(properties.limits)) need(false, limit);
  return missing;
}

bool hasExtension(VkPhysicalDevice device, std::string_view name) {
  std::uint32_t count = 0;
  if (vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr) != VK_SUCCESS) return false;
  std::vector<VkExtensionProperties> all(count);
  if (vkEnumerateDeviceExtensionProperties(device, nullptr, &count, all.data()) != VK_SUCCESS) return false;
  return std::ranges::any_of(all,
                             [&](const VkExtensionProperties& extension) { return extension.extensionName == name; });
}

/// Where it is plugged in, or else its UUID.
std::string identityOf(VkPhysicalDevice device) {
  VkPhysicalDevicePCIBusInfoPropertiesEXT place{};
  place.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PCI_BUS_INFO_PROPERTIES_EXT;
  VkPhysicalDeviceIDProperties own{};
  own.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES;
  const bool isPlaced = hasExtension(device, VK_EXT_PCI_BUS_INFO_EXTENSION_NAME);
  if (isPlaced) own.pNext = &place;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &own;
  vkGetPhysicalDeviceProperties2(device, &properties);
  std::string identity = isPlaced ? "PCI" : "UUID";
  if (isPlaced) {
    for (const std::uint32_t part : {place.pciDomain, place.pciBus, place.pciDevice, place.pciFunction})
      identity.append(" ").append(std::to_string(part));
  } else {
    for (const std::uint8_t byte : own.deviceUUID) identity.append(" ").append(std::to_string(byte));
  }
  return identity;
}

/// Who names the drivers gets the devices that they have, each of them.
bool areDriversChosen() {
  return std::ranges::any_of(std::array{"VK_DRIVER_FILES", "VK_ICD_FILENAMES", "VK_ADD_DRIVER_FILES"},
                             [](const char* name) { return std::getenv(name) != nullptr; });
}

DeviceInfo describe(VkPhysicalDevice device) {
  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  vkGetPhysicalDeviceProperties2(device, &properties);
  DeviceInfo info;
  if (properties.properties.apiVersion >= VK_API_VERSION_1_2) {
    properties.pNext = &driver;
    vkGetPhysicalDeviceProperties2(device, &properties);
    info.identity = identityOf(device);
  }
  info.name = properties.properties.deviceName;
  info.driver = driver.driverName;
  if (driver.driverInfo[0] != '\0') info.driver += " " + std::string(driver.driverInfo);
  info.type = typeName(properties.properties.deviceType);
  info.apiVersion = properties.properties.apiVersion;
  info.missing = missingFeatures(device, properties.properties);
  return info;
}

}  // namespace

std::optional<ComputeQueue> computeQueue(VkPhysicalDevice device) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  const auto found = std::ranges::find_if(
      families, [](const VkQueueFamilyProperties& family) { return (family.queueFlags & VK_QUEUE_COMPUTE_BIT) != 0; });
  if (found == families.end()) return std::nullopt;
  return ComputeQueue{static_cast<std::uint32_t>(found - families.begin()), found->timestampValidBits};
}

std::vector<PhysicalDevice> physicalDevices(VkInstance instance) {
  std::uint32_t count = 0;
  const VkResult result = vkEnumeratePhysicalDevices(instance, &count, nullptr);
  if (result == VK_ERROR_INITIALIZATION_FAILED || (result == VK_SUCCESS && count == 0)) {
    throw DeviceError("no Vulkan device was found", "", kInstallDriver);
  }
  check(result, "list the Vulkan devices", "");
  std::vector<VkPhysicalDevice> handles(count);
  check(vkEnumeratePhysicalDevices(instance, &count, handles.data()), "list the Vulkan devices", "");

  std::vector<DeviceInfo> infos;
  for (VkPhysicalDevice handle : handles) infos.push_back(describe(handle));
  if (!areDriversChosen()) markTwins(infos);
  if (const std::size_t best = defaultDevice(infos); best < infos.size()) infos[best].isDefault = true;
  std::vector<PhysicalDevice> devices;
  for (std::size_t i = 0; i < handles.size(); ++i) devices.push_back({handles[i], infos[i]});
  return devices;
}

std::vector<DeviceInfo> listDevices() {
  const Instance instance(false);
  std::vector<DeviceInfo> infos;
  for (PhysicalDevice& device : physicalDevices(instance.handle())) infos.push_back(std::move(device.info));
  return infos;
}

}  // namespace importon::gpu
