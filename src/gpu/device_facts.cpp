#include "gpu/device_facts.h"

#include <algorithm>
#include <bit>

#include "gpu/device_list.h"

namespace importon::gpu {
namespace {

void readQueueFamily(VkPhysicalDevice device, DeviceFacts& facts) {
  const ComputeQueue queue = computeQueue(device).value();  // chosen devices have one
  facts.queueFamily = queue.family;
  facts.timestampMask = queue.timestampBits >= 64 ? ~0ull : (1ull << queue.timestampBits) - 1;
}

/// Drivers of processors, as tests show (Arithmetic.*); Vulkan promises it of none.
bool roundsDivision(VkDriverId driver) {
  return driver == VK_DRIVER_ID_MESA_LLVMPIPE || driver == VK_DRIVER_ID_GOOGLE_SWIFTSHADER;
}

void readLimits(VkPhysicalDevice device, DeviceFacts& facts) {
  VkPhysicalDeviceMaintenance3Properties maintenance3{};
  maintenance3.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  driver.pNext = &maintenance3;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &driver;
  vkGetPhysicalDeviceProperties2(device, &properties);
  const VkPhysicalDeviceLimits& given = properties.properties.limits;
  std::copy(std::begin(given.maxComputeWorkGroupCount), std::end(given.maxComputeWorkGroupCount),
            facts.maxWorkgroupCount.begin());
  Limits& limits = facts.limits;
  limits.maxStorageBufferRange = given.maxStorageBufferRange;
  limits.maxTexelBufferElements = given.maxTexelBufferElements;
  limits.hasLargeTexelBuffers = hasLargeTexelBuffers(given);
  limits.roundsDivision = roundsDivision(driver.driverID);
  limits.maxAllocation = maintenance3.maxMemoryAllocationSize;
  limits.maxWorkgroupCountX = given.maxComputeWorkGroupCount[0];
  limits.maxWorkgroupSize = std::min(given.maxComputeWorkGroupSize[0], given.maxComputeWorkGroupInvocations);
  limits.nanosecondsPerTick = facts.timestampMask == 0 ? 0.0 : static_cast<double>(given.timestampPeriod);
  limits.isCpu = facts.info.type == "cpu";
}

void readMemory(VkPhysicalDevice device, DeviceFacts& facts) {
  vkGetPhysicalDeviceMemoryProperties(device, &facts.memory);
  constexpr VkMemoryPropertyFlags kHost =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  const bool sharesMemory = facts.info.type == "cpu" || facts.info.type == "integrated";
  const VkMemoryType& type =
      facts.memory
          .memoryTypes[*facts.memoryType(~0u, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | (sharesMemory ? kHost : 0))];
  facts.mapsBuffers = sharesMemory && (type.propertyFlags & kHost) == kHost;
  facts.limits.heapBytes = facts.memory.memoryHeaps[type.heapIndex].size;
}

}  // namespace

std::optional<std::uint32_t> DeviceFacts::memoryType(std::uint32_t typeBits, VkMemoryPropertyFlags needed,
                                                     VkMemoryPropertyFlags wanted) const {
  std::optional<std::uint32_t> best;
  int bestScore = -1;
  for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
    const VkMemoryPropertyFlags flags = memory.memoryTypes[i].propertyFlags;
    if ((typeBits & (1u << i)) == 0 || (flags & needed) != needed) continue;
    const int score = std::popcount(flags & wanted);
    if (score > bestScore) {
      best = i;
      bestScore = score;
    }
  }
  return best;
}

bool hasLargeTexelBuffers(const VkPhysicalDeviceLimits& limits) {
  constexpr std::uint32_t kLarge = 1u << 26;  // Vulkan promises 2^16, which hold no scene; others have this and more
  return limits.maxTexelBufferElements >= kLarge;
}

DeviceFacts readFacts(VkPhysicalDevice device, const DeviceInfo& info) {
  DeviceFacts facts;
  facts.info = info;
  readQueueFamily(device, facts);
  readLimits(device, facts);
  readMemory(device, facts);
  return facts;
}

}  // namespace importon::gpu
