/// What a compute shader's SPIR-V module says about itself, found when it was built (describe_kernels.cpp).
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace importon::gpu {

enum class BufferKind { storage, uniform, texels };

/// A buffer that code of the module reads or writes.
struct KernelBuffer {
  std::uint32_t slot;  // its binding in set 0
  BufferKind kind;
  std::string_view name;
};

struct KernelCode {
  std::string_view name;  // of its file, without .comp
  const std::uint32_t *begin, *end;
  const std::uint32_t* leanEnd;           // words of the lean module (optimise_module.cpp) follow the others; none: end
  const std::uint32_t* placedEnd;         // and after them those of the one for placed meshes; none: leanEnd
  std::span<const std::uint32_t> rare;    // ids of the specialization constants that the lean module takes for 0
  std::span<const KernelBuffer> buffers;  // by slot
  std::uint32_t pushConstantBytes;
  std::uint32_t workgroupSize;  // along x, before specialization
  bool hasWorkgroupConstant;    // the specialization constant 0 sets that size

  [[nodiscard]] std::span<const std::uint32_t> spirv() const { return {begin, end}; }
  [[nodiscard]] std::span<const std::uint32_t> lean() const { return {end, leanEnd}; }
  [[nodiscard]] std::span<const std::uint32_t> placed() const { return {leanEnd, placedEnd}; }
};

}  // namespace importon::gpu
