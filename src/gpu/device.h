/// The open device that buffers, kernels and recorders share.
#pragma once
#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "gpu/context.h"
#include "gpu/device_facts.h"
#include "gpu/handle.h"
#include "gpu/instance.h"
#include "gpu/pipeline_file.h"

namespace importon::gpu {

class Staging;

/// Instance, device and queue. Shared by the context and everything made from it, so that these may be
/// destroyed in any order and from any thread.
class Device {
 public:
  explicit Device(const ContextOptions& options);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  [[nodiscard]] VkDevice handle() const { return device_; }
  [[nodiscard]] const DeviceFacts& facts() const { return facts_; }
  [[nodiscard]] const DeviceInfo& info() const { return facts_.info; }
  [[nodiscard]] const Limits& limits() const { return facts_.limits; }
  [[nodiscard]] VkPipelineCache pipelineCache() const { return pipelineCache_.get(); }
  [[nodiscard]] ValidationLog& validationLog() { return instance_.validationLog(); }

  /// Submits and waits; serialised, since a queue takes one thread at a time.
  [[nodiscard]] VkResult submitAndWait(VkCommandBuffer commands, VkFence fence);
  /// True once a submission has found the device lost.
  [[nodiscard]] bool isLost() const { return isLost_; }

  void countAllocation(std::uint64_t bytes);
  void countRelease(std::uint64_t bytes);
  [[nodiscard]] std::uint64_t allocatedBytes() const { return allocatedBytes_; }
  [[nodiscard]] std::uint64_t peakBytes() const { return peakBytes_; }

  /// Shows in validation messages and captures; does nothing without validation.
  void setDebugName(VkObjectType type, std::uint64_t object, const std::string& name) const {
    instance_.setDebugName(device_, type, object, name);
  }

  /// Host-visible memory for transfers, made when first used.
  [[nodiscard]] Staging& staging();

 private:
  void open(VkPhysicalDevice physical);
  void makePipelineCache(VkPhysicalDevice physical, const ContextOptions& options);
  void keepPipelines() const;
  void close();
  [[nodiscard]] VkResult submit(VkCommandBuffer commands, VkFence fence);

  Instance instance_;
  DeviceFacts facts_;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  PipelineCacheHandle pipelineCache_;
  std::optional<PipelineFile> pipelineFile_;
  std::vector<std::byte> keptPipelines_;  // as they were read
  std::mutex queueMutex_;
  std::mutex stagingMutex_;
  std::unique_ptr<Staging> staging_;
  std::atomic<bool> isLost_ = false;
  std::atomic<std::uint64_t> allocatedBytes_ = 0;
  std::atomic<std::uint64_t> peakBytes_ = 0;
};

/// The context is one share in the device.
struct Context::Impl {
  std::shared_ptr<Device> device;  // shared: see Device
};

}  // namespace importon::gpu
