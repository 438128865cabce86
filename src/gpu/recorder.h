/// Records dispatches in order, submits them, and keeps the time of each by label.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "gpu/kernel.h"

namespace importon::gpu {

struct KernelTime {
  std::string label;
  std::uint64_t launches = 0;
  double milliseconds = 0;  // device time by timestamps
};

/// A push-constant struct (not bytes that already stand for one).
template <class T>
concept PushConstants = std::is_trivially_copyable_v<T> && sizeof(T) <= 128 &&
                        !std::is_convertible_v<T, std::span<const std::byte>>;

/// Commands run in the order recorded; a full memory barrier stands between any two that touch buffers
/// (compute, indirect read, transfer, host). Buffers and kernels must outlive the submission. A long recording
/// is submitted in pieces on the way. A push-constant size that is not the kernel's, a missing buffer, or a copy
/// past the end of one is a std::logic_error; fills and copies are timed as "fill" and "copy".
class Recorder {
 public:
  explicit Recorder(Context& context);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Buffers are given in the order of the kernel's code. Runs ceil(invocations / workgroupSize) workgroups along x
  /// (folded into y where x would pass the device's limit; kernels compute their index by invocationIndex() of
  /// lib/dispatch.glsl and test it themselves). Does nothing for 0 invocations.
  void dispatch(const Kernel& kernel, std::span<const Buffer* const> buffers, std::uint64_t invocations,
                std::span<const std::byte> pushConstants = {});
  /// Takes the three group counts from `arguments` at byte `offset`.
  void dispatchIndirect(const Kernel& kernel, std::span<const Buffer* const> buffers, const Buffer& arguments,
                        std::uint64_t offset, std::span<const std::byte> pushConstants = {});
  template <PushConstants Push>
  void dispatch(const Kernel& kernel, std::span<const Buffer* const> buffers, std::uint64_t invocations,
                const Push& push) {
    dispatch(kernel, buffers, invocations, std::as_bytes(std::span(&push, 1)));
  }
  template <PushConstants Push>
  void dispatchIndirect(const Kernel& kernel, std::span<const Buffer* const> buffers, const Buffer& arguments,
                        std::uint64_t offset, const Push& push) {
    dispatchIndirect(kernel, buffers, arguments, offset, std::as_bytes(std::span(&push, 1)));
  }

  void fill(const Buffer& buffer, std::uint32_t value);  // whole buffer
  void copy(const Buffer& from, std::uint64_t fromOffset, const Buffer& to, std::uint64_t toOffset,
            std::uint64_t bytes);

  /// Submits what was recorded and waits until it is done. Throws DeviceError if the device is lost.
  void submitAndWait();
  /// Times since construction, in order of first use.
  [[nodiscard]] std::vector<KernelTime> times() const;

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace importon::gpu
