/// The open device that buffers, kernels and recorders share.
#pragma once
#include <vulkan/vulkan.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "gpu/context.h"
#include "gpu/handle.h"
#include "gpu/validation.h"

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
  [[nodiscard]] const DeviceInfo& info() const { return info_; }
  [[nodiscard]] const Limits& limits() const { return limits_; }
  [[nodiscard]] std::array<std::uint32_t, 3> maxWorkgroupCount() const { return maxWorkgroupCount_; }
  [[nodiscard]] std::uint32_t queueFamily() const { return queueFamily_; }
  /// The bits of a timestamp that count; 0: the queue has no timestamps.
  [[nodiscard]] std::uint64_t timestampMask() const { return timestampMask_; }
  [[nodiscard]] VkPipelineCache pipelineCache() const { return pipelineCache_.get(); }
  [[nodiscard]] ValidationLog& validationLog() { return validationLog_; }
  /// Device-local memory can be written and read by the host at full speed.
  [[nodiscard]] bool mapsBuffers() const { return mapsBuffers_; }

  /// Submits and waits; serialised, since a queue takes one thread at a time.
  [[nodiscard]] VkResult submitAndWait(VkCommandBuffer commands, VkFence fence);

  /// The type of memory among `typeBits` that has all of `needed` and most of `wanted`; none: nullopt.
  [[nodiscard]] std::optional<std::uint32_t> memoryType(std::uint32_t typeBits, VkMemoryPropertyFlags needed,
                                                        VkMemoryPropertyFlags wanted) const;

  void countAllocation(std::uint64_t bytes);
  void countRelease(std::uint64_t bytes);
  [[nodiscard]] std::uint64_t allocatedBytes() const { return allocatedBytes_; }
  [[nodiscard]] std::uint64_t peakBytes() const { return peakBytes_; }

  /// Shows in validation messages and captures; does nothing without validation.
  void setDebugName(VkObjectType type, std::uint64_t object, const std::string& name) const;

  /// Host-visible memory for transfers, made when first used.
  [[nodiscard]] Staging& staging();

 private:
  void createMessenger();
  void createDevice();
  void readLimits();
  void readQueueFamily();
  void destroy();

  ValidationLog validationLog_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  PFN_vkSetDebugUtilsObjectNameEXT setObjectName_ = nullptr;
  std::uint32_t queueFamily_ = 0;
  std::uint64_t timestampMask_ = 0;
  std::array<std::uint32_t, 3> maxWorkgroupCount_{};
  VkPhysicalDeviceMemoryProperties memory_{};
  DeviceInfo info_;
  Limits limits_;
  bool hasValidation_ = false;
  bool mapsBuffers_ = false;
  PipelineCacheHandle pipelineCache_;
  std::mutex queueMutex_;
  std::mutex stagingMutex_;
  std::unique_ptr<Staging> staging_;
  std::atomic<std::uint64_t> allocatedBytes_ = 0;
  std::atomic<std::uint64_t> peakBytes_ = 0;
};

/// The context is one share in the device.
struct Context::Impl {
  std::shared_ptr<Device> device;  // shared: see Device
};

}  // namespace importon::gpu
