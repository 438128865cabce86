#include "gpu/device.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <vector>

#include "gpu/device_choice.h"
#include "gpu/device_list.h"
#include "gpu/staging.h"
#include "gpu/vulkan_error.h"

namespace importon::gpu {

Device::Device(const ContextOptions& options) : hasValidation_(options.validation) {
  try {
    instance_ = createInstance(hasValidation_, validationLog_);
    createMessenger();
    const std::vector<PhysicalDevice> devices = physicalDevices(instance_);
    std::vector<DeviceInfo> infos;
    for (const PhysicalDevice& device : devices) infos.push_back(device.info);
    const std::size_t chosen = chooseDevice(infos, options.device);
    physical_ = devices[chosen].handle;
    info_ = infos[chosen];
    readQueueFamily();
    readLimits();
    mapsBuffers_ = mapsBuffers_ && !options.stagesTransfers;
    createDevice();
  } catch (...) {
    destroy();
    throw;
  }
}

Device::~Device() { destroy(); }

void Device::destroy() {
  staging_.reset();
  pipelineCache_ = {};
  if (device_ != VK_NULL_HANDLE) vkDestroyDevice(device_, nullptr);
  if (messenger_ != VK_NULL_HANDLE) {
    const auto destroyMessenger = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
    destroyMessenger(instance_, messenger_, nullptr);
  }
  if (instance_ != VK_NULL_HANDLE) vkDestroyInstance(instance_, nullptr);
}

void Device::createMessenger() {
  if (!hasValidation_) return;
  const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
  setObjectName_ = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(
      vkGetInstanceProcAddr(instance_, "vkSetDebugUtilsObjectNameEXT"));
  const auto info = messengerInfo(validationLog_);
  check(create(instance_, &info, nullptr, &messenger_), "listen to the validation layer", kValidationLayer);
}

void Device::readQueueFamily() {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, families.data());
  const auto found = std::find_if(families.begin(), families.end(), [](const VkQueueFamilyProperties& family) {
    return (family.queueFlags & VK_QUEUE_COMPUTE_BIT) != 0;
  });
  queueFamily_ = static_cast<std::uint32_t>(found - families.begin());
  const std::uint32_t bits = found->timestampValidBits;
  timestampMask_ = bits >= 64 ? ~0ull : (1ull << bits) - 1;
}

void Device::readLimits() {
  VkPhysicalDeviceMaintenance3Properties maintenance3{};
  maintenance3.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &maintenance3;
  vkGetPhysicalDeviceProperties2(physical_, &properties);
  vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);
  const VkPhysicalDeviceLimits& device = properties.properties.limits;
  std::copy(std::begin(device.maxComputeWorkGroupCount), std::end(device.maxComputeWorkGroupCount),
            maxWorkgroupCount_.begin());
  limits_.maxStorageBufferRange = device.maxStorageBufferRange;
  limits_.maxTexelBufferElements = device.maxTexelBufferElements;
  limits_.maxAllocation = maintenance3.maxMemoryAllocationSize;
  limits_.maxWorkgroupCountX = device.maxComputeWorkGroupCount[0];
  limits_.maxWorkgroupSize = std::min(device.maxComputeWorkGroupSize[0], device.maxComputeWorkGroupInvocations);
  limits_.nanosecondsPerTick = timestampMask_ == 0 ? 0.0 : static_cast<double>(device.timestampPeriod);
  limits_.isCpu = info_.type == "cpu";

  constexpr VkMemoryPropertyFlags kHost =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  const bool sharesMemory = info_.type == "cpu" || info_.type == "integrated";
  const std::uint32_t type = *memoryType(~0u, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | (sharesMemory ? kHost : 0));
  mapsBuffers_ = sharesMemory && (memory_.memoryTypes[type].propertyFlags & kHost) == kHost;
  limits_.heapBytes = memory_.memoryHeaps[memory_.memoryTypes[type].heapIndex].size;
}

void Device::createDevice() {
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = queueFamily_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkPhysicalDeviceVulkan12Features features12{};
  features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  features12.scalarBlockLayout = VK_TRUE;
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &features12;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  check(vkCreateDevice(physical_, &info, nullptr, &device_), "open the device", info_.name);
  vkGetDeviceQueue(device_, queueFamily_, 0, &queue_);

  VkPipelineCacheCreateInfo cacheInfo{};
  cacheInfo.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  VkPipelineCache cache = VK_NULL_HANDLE;
  check(vkCreatePipelineCache(device_, &cacheInfo, nullptr, &cache), "create a pipeline cache", info_.name);
  pipelineCache_ = {device_, cache};
}

VkResult Device::submitAndWait(VkCommandBuffer commands, VkFence fence) {
  VkSubmitInfo submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  if (const VkResult result = vkResetFences(device_, 1, &fence); result != VK_SUCCESS) return result;
  {
    const std::lock_guard lock(queueMutex_);
    if (const VkResult result = vkQueueSubmit(queue_, 1, &submit, fence); result != VK_SUCCESS) return result;
  }
  return vkWaitForFences(device_, 1, &fence, VK_TRUE, std::numeric_limits<std::uint64_t>::max());
}

std::optional<std::uint32_t> Device::memoryType(std::uint32_t typeBits, VkMemoryPropertyFlags needed,
                                                VkMemoryPropertyFlags wanted) const {
  std::optional<std::uint32_t> best;
  int bestScore = -1;
  for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
    const VkMemoryPropertyFlags flags = memory_.memoryTypes[i].propertyFlags;
    if ((typeBits & (1u << i)) == 0 || (flags & needed) != needed) continue;
    const int score = std::popcount(flags & wanted);
    if (score > bestScore) {
      best = i;
      bestScore = score;
    }
  }
  return best;
}

void Device::countAllocation(std::uint64_t bytes) {
  const std::uint64_t now = allocatedBytes_ += bytes;
  std::uint64_t peak = peakBytes_;
  while (peak < now && !peakBytes_.compare_exchange_weak(peak, now)) {
  }
}

void Device::countRelease(std::uint64_t bytes) { allocatedBytes_ -= bytes; }

void Device::setDebugName(VkObjectType type, std::uint64_t object, const std::string& name) const {
  if (setObjectName_ == nullptr) return;
  VkDebugUtilsObjectNameInfoEXT info{};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT;
  info.objectType = type;
  info.objectHandle = object;
  info.pObjectName = name.c_str();
  check(setObjectName_(device_, &info), "name an object", name);
}

Staging& Device::staging() {
  const std::lock_guard lock(stagingMutex_);
  if (!staging_) staging_ = std::make_unique<Staging>(*this);
  return *staging_;
}

}  // namespace importon::gpu
