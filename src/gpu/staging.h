/// Copies between the host and device memory that it cannot map.
#pragma once
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>

#include "gpu/handle.h"

namespace importon::gpu {

class Device;

/// One host-visible buffer, through which transfers pass in pieces. Thread-safe.
class Staging {
 public:
  explicit Staging(Device& device);
  ~Staging();
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  /// Wait until the bytes have arrived. Throw DeviceError.
  void upload(VkBuffer to, std::uint64_t offset, std::span<const std::byte> data);
  void download(VkBuffer from, std::uint64_t offset, std::span<std::byte> data);
  /// Sets all of it to 0, and waits.
  void clear(VkBuffer buffer);

 private:
  void createBuffer();
  /// Records, submits and waits.
  template <class Record>
  void submit(const Record& record);
  void copy(VkBuffer from, std::uint64_t fromOffset, VkBuffer to, std::uint64_t toOffset, std::uint64_t bytes);

  Device& device_;
  std::mutex mutex_;
  BufferHandle buffer_;
  MemoryHandle memory_;
  std::byte* mapped_ = nullptr;
  CommandPoolHandle commandPool_;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  FenceHandle fence_;
};

}  // namespace importon::gpu
