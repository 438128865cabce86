#include "gpu/device.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "gpu/device_choice.h"
#include "gpu/device_list.h"
#include "gpu/staging.h"
#include "gpu/vulkan_error.h"

namespace importon::gpu {

Device::Device(const ContextOptions& options) : instance_(options.validation) {
  const std::vector<PhysicalDevice> devices = physicalDevices(instance_.handle());
  std::vector<DeviceInfo> infos;
  for (const PhysicalDevice& device : devices) infos.push_back(device.info);
  const std::size_t chosen = chooseDevice(infos, options.device);
  facts_ = readFacts(devices[chosen].handle, infos[chosen]);
  facts_.mapsBuffers = facts_.mapsBuffers && !options.stagesTransfers;
  try {
    open(devices[chosen].handle);
    makePipelineCache(devices[chosen].handle, options);
  } catch (...) {
    close();
    throw;
  }
}

Device::~Device() { close(); }

void Device::close() {
  staging_.reset();
  keepPipelines();
  pipelineCache_ = {};
  if (device_ != VK_NULL_HANDLE) vkDestroyDevice(device_, nullptr);
}

void Device::open(VkPhysicalDevice physical) {
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = facts_.queueFamily;
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
  check(vkCreateDevice(physical, &info, nullptr, &device_), "open the device", facts_.info.name);
  vkGetDeviceQueue(device_, facts_.queueFamily, 0, &queue_);
}

void Device::makePipelineCache(VkPhysicalDevice physical, const ContextOptions& options) {
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(physical, &properties);
  PipelineKey key{{}, properties.vendorID, properties.deviceID, properties.driverVersion, options.kernels};
  std::ranges::copy(properties.pipelineCacheUUID, key.cacheId.begin());
  pipelineFile_.emplace(options.cacheFolder, key);
  keptPipelines_ = pipelineFile_->read();
  VkPipelineCacheCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  info.initialDataSize = keptPipelines_.size();
  info.pInitialData = keptPipelines_.data();
  VkPipelineCache cache = VK_NULL_HANDLE;
  if (keptPipelines_.empty() || vkCreatePipelineCache(device_, &info, nullptr, &cache) != VK_SUCCESS) {
    keptPipelines_.clear();
    info.initialDataSize = 0;
    check(vkCreatePipelineCache(device_, &info, nullptr, &cache), "create a pipeline cache", facts_.info.name);
  }
  pipelineCache_ = {device_, cache};
}

/// Some drivers have nothing to keep but the header.
void Device::keepPipelines() const {
  std::size_t bytes = 0;
  if (!pipelineFile_ || !pipelineFile_->isKept() || pipelineCache_.get() == VK_NULL_HANDLE) return;
  if (vkGetPipelineCacheData(device_, pipelineCache_.get(), &bytes, nullptr) != VK_SUCCESS) return;
  if (bytes <= sizeof(VkPipelineCacheHeaderVersionOne)) return;
  std::vector<std::byte> data(bytes);
  if (vkGetPipelineCacheData(device_, pipelineCache_.get(), &bytes, data.data()) != VK_SUCCESS) return;
  data.resize(bytes);
  if (data != keptPipelines_) pipelineFile_->write(data);
}

VkResult Device::submitAndWait(VkCommandBuffer commands, VkFence fence) {
  VkResult result = submit(commands, fence);
  if (result == VK_SUCCESS)
    result = vkWaitForFences(device_, 1, &fence, VK_TRUE, std::numeric_limits<std::uint64_t>::max());
  if (result == VK_ERROR_DEVICE_LOST) isLost_ = true;
  return result;
}

VkResult Device::submit(VkCommandBuffer commands, VkFence fence) {
  VkSubmitInfo submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  if (const VkResult result = vkResetFences(device_, 1, &fence); result != VK_SUCCESS) return result;
  const std::lock_guard lock(queueMutex_);
  return vkQueueSubmit(queue_, 1, &submit, fence);
}

void Device::countAllocation(std::uint64_t bytes) {
  const std::uint64_t now = allocatedBytes_ += bytes;
  std::uint64_t peak = peakBytes_;
  while (peak < now && !peakBytes_.compare_exchange_weak(peak, now)) {
  }
}

void Device::countRelease(std::uint64_t bytes) { allocatedBytes_ -= bytes; }

Staging& Device::staging() {
  const std::lock_guard lock(stagingMutex_);
  if (!staging_) staging_ = std::make_unique<Staging>(*this);
  return *staging_;
}

}  // namespace importon::gpu
