/// Descriptor sets that live until the next submission is done.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gpu/handle.h"
#include "gpu/kernel_impl.h"

namespace importon::gpu {

/// Hands out sets from pools, adds pools when they are full, and takes all sets back at once.
class DescriptorArena {
 public:
  explicit DescriptorArena(Device& device) : device_(device) {}

  /// A set that binds `buffers`, in the order of the kernel's code. Throws std::logic_error for an empty buffer or one
  /// without texel format where one is needed; DeviceError for a buffer that is too large to bind.
  [[nodiscard]] VkDescriptorSet bind(const Kernel& kernel, std::span<const Buffer* const> buffers);

  /// All sets are free again.
  void reset();

 private:
  struct Use {
    std::uint32_t sets = 0;
    std::array<std::uint32_t, 3> descriptors{};  // by BufferKind
  };
  [[nodiscard]] VkDescriptorSet allocate(const Kernel& kernel);
  void addPool();

  Device& device_;
  std::vector<DescriptorPoolHandle> pools_;
  std::size_t current_ = 0;  // pool in use
  Use use_;                  // of that pool
};

}  // namespace importon::gpu
