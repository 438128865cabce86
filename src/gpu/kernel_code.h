/// What a compute shader's SPIR-V module says about itself, found when it was built (modules/describe_kernels.cpp).
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
  std::uint32_t texelWords;  // 32-bit words of a texel, 1, 2 or 4; 0: not texels
};

struct KernelCode {
  std::string_view name;  // of its file, without .comp
  const std::uint32_t *begin, *end;
  const std::uint32_t* leanEnd;  // words of the lean module (modules/optimise_module.cpp) follow the others; none: end
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

/// What the kernel that binds most binds: more than Vulkan promises, so a device is asked before anything is built.
struct MostDescriptors {
  std::uint32_t storage, texels, uniform;
  std::uint32_t storageAndTexels;  // of one kernel, where texels are read from storage buffers
};
inline constexpr MostDescriptors kMostDescriptors{12, 18, 2, 30};

}  // namespace importon::gpu
