/// Kernels that several renders on one device share.
#pragma once
#include <cstddef>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/kernel.h"

namespace importon::gpu {

/// Makes each kernel once. Two requests get the same one if code and label are the same, and all constants that the
/// code declares: others, which differ between scenes, change nothing. From any thread. The context must last.
class KernelCache {
 public:
  explicit KernelCache(Context& context) : context_(context) {}

  /// Lasts until clear(). Throws DeviceError.
  [[nodiscard]] const Kernel& find(std::string_view label, const KernelCode& code,
                                   std::span<const Specialization> constants);
  [[nodiscard]] std::size_t size() const;
  /// CPU time that compiling took so far, ms by label.
  [[nodiscard]] std::map<std::string, double> compileTimes() const;
  /// Not while a kernel of it is in use.
  void clear();

 private:
  struct Key {
    const KernelCode* code;
    std::string label;
    std::vector<std::uint64_t> constants;  // those that the code declares, by id: id and value
    auto operator<=>(const Key&) const = default;
  };
  [[nodiscard]] Key keyOf(std::string_view label, const KernelCode& code, std::span<const Specialization> constants);

  Context& context_;
  mutable std::mutex mutex_;                                          // of the next two
  std::map<const KernelCode*, std::vector<std::uint32_t>> declared_;  // ids
  std::map<Key, Kernel> kernels_;
};

/// Ids of the specialization constants that a SPIR-V module declares, rising.
[[nodiscard]] std::vector<std::uint32_t> declaredConstants(std::span<const std::uint32_t> spirv);

}  // namespace importon::gpu
