/// A compute pipeline made from an embedded SPIR-V module.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "gpu/buffer.h"
#include "gpu/kernel_code.h"

namespace importon::gpu {

struct Specialization {
  std::uint32_t id;
  std::uint32_t value;  // bits of a bool, int, uint or float constant
};

/// Throws DeviceError. The driver is given the module, which must live as long as the kernel, when the kernel is first
/// dispatched, or before by compile(). Lavapipe makes machine code at the first dispatch only, whose time then holds
/// that unless the driver finds the code in its cache on disk.
class Kernel {
 public:
  Kernel();
  Kernel(Context& context, std::string label, const KernelCode& code,
         std::span<const Specialization> specialization = {});
  ~Kernel();
  Kernel(Kernel&&) noexcept;
  Kernel& operator=(Kernel&&) noexcept;

  [[nodiscard]] const std::string& label() const { return label_; }
  /// Compiles the kernel unless that is done; waits where another thread is at it. From any thread. Throws DeviceError.
  void compile() const;
  /// Time of a thread in compile(); 0 until that is done.
  [[nodiscard]] double compileMilliseconds() const;
  /// Invocations per workgroup along x after specialization.
  [[nodiscard]] std::uint32_t workgroupSize() const;

  struct Impl;
  [[nodiscard]] Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
  std::string label_;
};

}  // namespace importon::gpu
