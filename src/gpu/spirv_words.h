/// The instructions of a SPIR-V module, one after the other.
#pragma once
#include <spirv_cross/spirv.h>

#include <cstdint>
#include <span>

namespace importon::gpu {

constexpr std::size_t kSpirvHeaderWords = 5;
constexpr std::size_t kSpirvBoundWord = 3;  // above all ids [SPIR-V 1.5, 2.3]

using SpirvInstruction = std::span<const std::uint32_t>;  // its first word tells length and operation

[[nodiscard]] inline SpvOp operationOf(SpirvInstruction instruction) {
  return static_cast<SpvOp>(instruction[0] & SpvOpCodeMask);
}

/// Calls `visit(instruction)` for each; false where one ends beyond the module. [SPIR-V 1.5, 2.3]
template <class Visit>
[[nodiscard]] bool forEachInstruction(std::span<const std::uint32_t> module, Visit&& visit) {
  for (std::size_t at = kSpirvHeaderWords; at < module.size();) {
    const std::size_t count = module[at] >> SpvWordCountShift;
    if (count == 0 || count > module.size() - at) return false;
    visit(module.subspan(at, count));
    at += count;
  }
  return true;
}

}  // namespace importon::gpu
