/// What a compute shader's SPIR-V module says about itself: bindings, push constants, workgroup size, and the
/// layout of the structs in its buffers. Knows what glslang makes of our kernels, not all of SPIR-V.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace importon::gpu {

enum class BindingKind { storageBuffer, uniformBuffer, uniformTexelBuffer };

struct ReflectedBinding {
  std::uint32_t slot;
  BindingKind kind;
  std::string name;
};

struct ReflectedMember {
  std::string name;
  std::uint32_t offset;  // bytes
  std::uint32_t bytes;   // 0: an array of unknown length
};

/// A struct that lies in a storage, uniform or push-constant block.
struct ReflectedStruct {
  std::string name;
  std::vector<ReflectedMember> members;
  std::uint32_t bytes = 0;        // to the end of the last member
  std::uint32_t arrayStride = 0;  // bytes; 0: there is no array of it
  /// The block itself when it only wraps one thing (`buffer Rays { Ray rays[]; }`).
  bool isWrapper = false;
};

struct Reflection {
  std::vector<ReflectedBinding> bindings;  // of set 0, those that code reads or writes, by slot
  std::uint32_t pushConstantBytes = 0;
  std::array<std::uint32_t, 3> workgroupSize{1, 1, 1};  // by default, before specialization
  std::optional<std::uint32_t> workgroupSizeXConstant;  // id of the specialization constant that sets x
  std::vector<ReflectedStruct> structs;                 // each type once
};

/// Throws std::logic_error for what is not a module, or uses what our kernels must not: other sets, arrays of
/// descriptors, images, storage texel buffers.
[[nodiscard]] Reflection reflect(std::span<const std::uint32_t> spirv);

}  // namespace importon::gpu
