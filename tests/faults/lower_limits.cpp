#include "lower_limits.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>

namespace importon::test {
namespace {

bool isLow(const std::string& name) {
  const char* const text = std::getenv("IMPORTON_TEST_LIMITS");
  std::istringstream names(text == nullptr ? "" : text);
  for (std::string each; std::getline(names, each, ',');)
    if (each == name || (each == "all" && name != "descriptors" && name != "driver")) return true;
  return false;
}

template <class T>
void lower(T& limit, std::uint64_t promised) {
  limit = static_cast<T>(std::min<std::uint64_t>(limit, promised));
}

}  // namespace

// Vulkan 1.2, table "Required Limits".
void lowerLimits(VkPhysicalDeviceLimits& limits) {
  if (isLow("texels")) lower(limits.maxTexelBufferElements, 65536);
  if (isLow("ranges")) {
    lower(limits.maxStorageBufferRange, 1u << 27);
    lower(limits.maxUniformBufferRange, 16384);
    lower(limits.maxPushConstantsSize, 128);
  }
  if (isLow("workgroups")) {
    lower(limits.maxComputeWorkGroupInvocations, 128);
    for (int i = 0; i < 3; ++i) {
      lower(limits.maxComputeWorkGroupSize[i], i == 2 ? 64 : 128);
      lower(limits.maxComputeWorkGroupCount[i], 65535);
    }
  }
  if (isLow("shared")) lower(limits.maxComputeSharedMemorySize, 16384);
  if (isLow("allocations")) lower(limits.maxMemoryAllocationCount, 4096);
  if (isLow("timestamps")) {
    limits.timestampComputeAndGraphics = VK_FALSE;
    limits.timestampPeriod = 0;
  }
  if (isLow("descriptors")) {
    lower(limits.maxBoundDescriptorSets, 4);
    lower(limits.maxPerStageDescriptorStorageBuffers, 4);
    lower(limits.maxPerStageDescriptorUniformBuffers, 12);
    lower(limits.maxPerStageDescriptorSampledImages, 16);
    lower(limits.maxPerStageResources, 128);
  }
}

void lowerLimits(VkPhysicalDeviceMaintenance3Properties& properties) {
  if (isLow("allocations")) lower(properties.maxMemoryAllocationSize, 1u << 30);
  if (isLow("descriptors")) lower(properties.maxPerSetDescriptors, 1024);
}

void lowerLimits(VkPhysicalDeviceDriverProperties& properties) {
  if (isLow("driver")) properties.driverID = VK_DRIVER_ID_MAX_ENUM;
}

void lowerLimits(VkQueueFamilyProperties& family) {
  if (isLow("timestamps")) family.timestampValidBits = 0;
}

}  // namespace importon::test
