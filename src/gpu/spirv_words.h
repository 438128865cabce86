/// The instructions of a SPIR-V module, one after the other.
#pragma once
#include <spirv_cross/spirv.h>

#include <cstdint>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <vector>

namespace importon::gpu {

using SpirvInstruction = std::span<const std::uint32_t>;  // its first word tells length and operation

// [SPIR-V 1.5, 2.3]
inline constexpr std::size_t kSpirvHeaderWords = 5;
inline constexpr std::size_t kSpirvBoundWord = 3;  // above all ids

[[nodiscard]] inline SpvOp operationOf(SpirvInstruction instruction) {
  return static_cast<SpvOp>(instruction[0] & SpvOpCodeMask);
}

/// Calls `visit(instruction)` for each. Throws std::logic_error where one ends beyond the module.
template <class Visit>
void forEachInstruction(std::span<const std::uint32_t> module, Visit&& visit) {
  for (std::size_t at = kSpirvHeaderWords; at < module.size();) {
    const std::size_t count = module[at] >> SpvWordCountShift;
    if (count == 0 || count > module.size() - at) throw std::logic_error("an instruction ends beyond its module");
    visit(module.subspan(at, count));
    at += count;
  }
}

[[nodiscard]] inline bool declaresType(SpvOp operation) {
  return operation >= SpvOpTypeVoid && operation <= SpvOpTypeForwardPointer;
}

inline void appendInstruction(std::vector<std::uint32_t>& words, SpvOp operation,
                              std::span<const std::uint32_t> operands) {
  words.push_back(static_cast<std::uint32_t>(operands.size() + 1) << SpvWordCountShift | operation);
  words.insert(words.end(), operands.begin(), operands.end());
}

inline void appendInstruction(std::vector<std::uint32_t>& words, SpvOp operation,
                              std::initializer_list<std::uint32_t> operands) {
  appendInstruction(words, operation, std::span(operands.begin(), operands.size()));
}

}  // namespace importon::gpu
