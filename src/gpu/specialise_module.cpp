#include "gpu/specialise_module.h"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "gpu/spirv_words.h"

namespace importon::gpu {
namespace {

using Id = std::uint32_t;
using Words = std::vector<std::uint32_t>;
using Value = std::optional<std::uint32_t>;  // of a Boolean or a 32-bit constant

/// Of two scalars, of which one may do.
Value valueOf(SpvOp operation, Value a, Value b) {
  if (operation == SpvOpLogicalAnd && (a == 0u || b == 0u)) return 0u;
  if (operation == SpvOpLogicalOr && (a == 1u || b == 1u)) return 1u;
  if (!a || !b) return {};
  switch (operation) {
    case SpvOpLogicalAnd:
    case SpvOpLogicalOr:
      return *a;  // that which decides nothing
    case SpvOpLogicalEqual:
    case SpvOpIEqual:
      return *a == *b;
    case SpvOpLogicalNotEqual:
    case SpvOpINotEqual:
      return *a != *b;
    case SpvOpUGreaterThan:
      return *a > *b;
    case SpvOpUGreaterThanEqual:
      return *a >= *b;
    case SpvOpULessThan:
      return *a < *b;
    case SpvOpULessThanEqual:
      return *a <= *b;
    default:
      return {};
  }
}

/// True for what does nothing but make its result.
bool isPure(SpirvInstruction i) {
  constexpr std::uint32_t kModf = 35, kFrexp = 51;  // of GLSL.std.450, which write through a pointer
  const SpvOp operation = operationOf(i);
  if (operation == SpvOpLoad) return i.size() < 5 || (i[4] & SpvMemoryAccessVolatileMask) == 0;
  if (operation == SpvOpExtInst) return i[4] != kModf && i[4] != kFrexp;
  const auto isAmong = [operation](SpvOp first, SpvOp last) { return operation >= first && operation <= last; };
  return operation == SpvOpUndef || operation == SpvOpAccessChain || operation == SpvOpInBoundsAccessChain ||
         operation == SpvOpArrayLength || operation == SpvOpPhi || operation == SpvOpImageFetch ||
         isAmong(SpvOpVectorExtractDynamic, SpvOpTranspose) || isAmong(SpvOpImage, SpvOpImageQuerySamples) ||
         isAmong(SpvOpConvertFToU, SpvOpBitcast) || isAmong(SpvOpSNegate, SpvOpSMulExtended) ||
         isAmong(SpvOpAny, SpvOpFUnordGreaterThanEqual) || isAmong(SpvOpShiftRightLogical, SpvOpBitCount);
}

struct Block {
  std::size_t label, end;        // instructions: its OpLabel, and its last one
  std::vector<Id> successors{};  // labels
  Id merge = 0, goesOn = 0;      // labels that its merge instruction names; 0: none
  bool isFolded = false;         // its branch is never taken otherwise
  bool isReached = false;
};

class Specialiser {
 public:
  Specialiser(std::span<const std::uint32_t> module, std::span<const Specialization> constants)
      : module_(module), constants_(constants), known_(module[kSpirvBoundWord]), definitions_(module[kSpirvBoundWord]) {
    forEachInstruction(module, [this](SpirvInstruction i) { code_.push_back(i); });
    for (std::size_t at = 0; at < code_.size(); ++at) readValue(at);
    readBlocks();
    reachBlocks();
  }

  [[nodiscard]] Words words() {
    if (!isWhole_) return {module_.begin(), module_.end()};
    markUsed();
    Words out(module_.begin(), module_.begin() + kSpirvHeaderWords);
    std::size_t at = 0;
    for (const Block& block : blocks_) {
      for (; at < block.label; ++at) writeDeclaration(out, at);
      if (block.isReached)
        writeBlock(out, block);
      else if (isMergeOfReached(code_[block.label][1]))
        writeStub(out, block);
      at = block.end + 1;
    }
    for (; at < code_.size(); ++at) writeDeclaration(out, at);
    return out;
  }

 private:
  [[nodiscard]] Value givenTo(Id id, std::uint32_t byDefault) const {
    const auto spec = specIds_.find(id);
    if (spec == specIds_.end()) return byDefault;
    if (spec->second == 0) return {};
    for (const Specialization& s : constants_)
      if (s.id == spec->second) return s.value;
    return byDefault;
  }

  [[nodiscard]] Value operand(SpirvInstruction i, std::size_t at) const {
    return at < i.size() ? known_[i[at]] : Value();
  }

  /// Notes what an instruction says of constants, and where its result is made.
  void readValue(std::size_t at) {
    const SpirvInstruction i = code_[at];
    const SpvOp operation = operationOf(i);
    if (operation == SpvOpDecorate && i.size() == 4 && i[2] == SpvDecorationSpecId) specIds_[i[1]] = i[3];
    if (operation == SpvOpConstantTrue || operation == SpvOpConstantFalse)
      known_[i[2]] = operation == SpvOpConstantTrue;
    else if (operation == SpvOpSpecConstantTrue || operation == SpvOpSpecConstantFalse)
      known_[i[2]] = givenTo(i[2], operation == SpvOpSpecConstantTrue);
    else if ((operation == SpvOpConstant || operation == SpvOpSpecConstant) && i.size() == 4)
      known_[i[2]] = operation == SpvOpConstant ? i[3] : givenTo(i[2], i[3]);
    else if (operation == SpvOpSpecConstantOp)
      known_[i[2]] = resultOf(static_cast<SpvOp>(i[3]), i, 4);
    else if (operation >= SpvOpLogicalEqual && operation <= SpvOpULessThanEqual)
      known_[i[2]] = resultOf(operation, i, 3);
    if (isPure(i)) definitions_[i[2]] = at;
  }

  [[nodiscard]] Value resultOf(SpvOp operation, SpirvInstruction i, std::size_t first) const {
    const Value a = operand(i, first);
    if (operation == SpvOpLogicalNot) return a ? Value(*a == 0 ? 1u : 0u) : Value();
    if (operation == SpvOpSelect) return a ? operand(i, first + (*a != 0 ? 1 : 2)) : Value();
    return valueOf(operation, a, operand(i, first + 1));
  }

  void readBlocks() {
    for (std::size_t at = 0; at < code_.size(); ++at) {
      const SpirvInstruction i = code_[at];
      const SpvOp operation = operationOf(i);
      if (operation == SpvOpFunction) isEntry_ = true;
      if (operation == SpvOpLabel) {
        blockAt_[i[1]] = blocks_.size();
        blocks_.push_back({at, at});
        if (std::exchange(isEntry_, false)) entries_.push_back(i[1]);
      }
      if (blocks_.empty()) continue;
      Block& block = blocks_.back();
      if (operation == SpvOpSelectionMerge || operation == SpvOpLoopMerge) block.merge = i[1];
      if (operation == SpvOpLoopMerge) block.goesOn = i[2];
      if (operation == SpvOpBranch || operation == SpvOpBranchConditional || operation == SpvOpSwitch ||
          (operation >= SpvOpKill && operation <= SpvOpUnreachable)) {
        block.end = at;
        readSuccessors(block, i);
      }
    }
  }

  void readSuccessors(Block& block, SpirvInstruction i) {
    const SpvOp operation = operationOf(i);
    if (operation == SpvOpBranch) block.successors = {i[1]};
    if (operation == SpvOpSwitch) {  // of a 32-bit selector: default, then literals and labels
      block.successors = {i[2]};
      for (std::size_t k = 4; k < i.size(); k += 2) block.successors.push_back(i[k]);
    }
    if (operation != SpvOpBranchConditional) return;
    block.isFolded = known_[i[1]].has_value() && block.goesOn == 0;
    if (block.isFolded) {
      block.successors = {*known_[i[1]] != 0 ? i[2] : i[3]};
      block.merge = 0;
    } else {
      block.successors = {i[2], i[3]};
    }
  }

  /// Where a loop's way back is never reached, the values that it brings would be gone: nothing is changed.
  void reachBlocks() {
    std::vector<Id> open = entries_;
    while (!open.empty()) {
      Block& block = blocks_[blockAt_.at(open.back())];
      open.pop_back();
      if (std::exchange(block.isReached, true)) continue;
      open.insert(open.end(), block.successors.begin(), block.successors.end());
    }
    for (const Block& block : blocks_) {
      if (!block.isReached) continue;
      if (block.merge != 0) merges_.push_back(block.merge);
      isWhole_ = isWhole_ && (block.goesOn == 0 || blocks_[blockAt_.at(block.goesOn)].isReached);
    }
    std::ranges::sort(merges_);
  }

  [[nodiscard]] bool isMergeOfReached(Id label) const { return std::ranges::binary_search(merges_, label); }
  [[nodiscard]] bool comesFrom(Id parent, Id label) const {
    const Block& from = blocks_[blockAt_.at(parent)];
    return from.isReached && std::ranges::find(from.successors, label) != from.successors.end();
  }

  /// Words that might be ids count as such: at worst too much is kept.
  void markUsed() {
    used_.assign(module_[kSpirvBoundWord], false);
    std::vector<Id> open;
    const auto use = [&](std::uint32_t id) {
      if (id < used_.size() && !used_[id]) {
        used_[id] = true;
        if (definitions_[id] != 0) open.push_back(id);
      }
    };
    for (const Block& block : blocks_)
      for (std::size_t at = block.label; block.isReached && at <= block.end; ++at)
        if (!isPure(code_[at]) && !(block.isFolded && at == block.end))
          std::ranges::for_each(code_[at].subspan(1), use);
    while (!open.empty()) {
      const SpirvInstruction i = code_[definitions_[open.back()]];
      open.pop_back();
      std::ranges::for_each(i.subspan(3), use);
    }
  }

  void write(Words& out, SpirvInstruction i) const { out.insert(out.end(), i.begin(), i.end()); }

  void writeDeclaration(Words& out, std::size_t at) const {
    const SpirvInstruction i = code_[at];
    const SpvOp operation = operationOf(i);
    if (operation == SpvOpName || operation == SpvOpMemberName) return;
    if (operation == SpvOpDecorate) {
      if (i[2] == SpvDecorationSpecId && known_[i[1]]) return;
      if (definitions_[i[1]] != 0 && !isKept(i[1])) return;
    }
    const bool isOpen = operation >= SpvOpSpecConstantTrue && operation <= SpvOpSpecConstantOp;
    if (!isOpen || operation == SpvOpSpecConstantComposite || !known_[i[2]]) {
      write(out, i);
      return;
    }
    const std::uint32_t value = *known_[i[2]];
    if (operation == SpvOpSpecConstant || !isBoolean(i[1]))
      appendInstruction(out, SpvOpConstant, std::array{i[1], i[2], value});
    else
      appendInstruction(out, value != 0 ? SpvOpConstantTrue : SpvOpConstantFalse, std::array{i[1], i[2]});
  }

  [[nodiscard]] bool isBoolean(Id type) const {
    return std::ranges::any_of(code_,
                               [type](SpirvInstruction i) { return operationOf(i) == SpvOpTypeBool && i[1] == type; });
  }

  [[nodiscard]] bool isKept(Id id) const {
    const auto block = std::ranges::upper_bound(blocks_, definitions_[id], {}, &Block::label);
    return used_[id] && block != blocks_.begin() && std::prev(block)->isReached;
  }

  void writeBlock(Words& out, const Block& block) const {
    for (std::size_t at = block.label; at <= block.end; ++at) {
      const SpirvInstruction i = code_[at];
      const SpvOp operation = operationOf(i);
      if (isPure(i) && !used_[i[2]]) continue;
      if (operation == SpvOpPhi)
        writePhi(out, i, code_[block.label][1]);
      else if (block.isFolded && at == block.end)
        appendInstruction(out, SpvOpBranch, block.successors);
      else if (!block.isFolded || operation != SpvOpSelectionMerge)
        write(out, i);
    }
  }

  void writePhi(Words& out, SpirvInstruction i, Id label) const {
    Words operands{i[1], i[2]};
    for (std::size_t k = 3; k + 1 < i.size(); k += 2)
      if (comesFrom(i[k + 1], label)) operands.insert(operands.end(), {i[k], i[k + 1]});
    appendInstruction(out, SpvOpPhi, operands);
  }

  /// A block that is only named.
  void writeStub(Words& out, const Block& block) const {
    write(out, code_[block.label]);
    appendInstruction(out, SpvOpUnreachable, {});
  }

  std::span<const std::uint32_t> module_;
  std::span<const Specialization> constants_;
  std::vector<SpirvInstruction> code_;
  std::vector<Value> known_;              // by id
  std::vector<std::size_t> definitions_;  // by id: the pure instruction that makes it; 0: none
  std::unordered_map<Id, std::uint32_t> specIds_;
  std::vector<Block> blocks_;
  std::unordered_map<Id, std::size_t> blockAt_;  // by label
  std::vector<Id> entries_, merges_;             // labels: of functions; of what merges, rising
  std::vector<bool> used_;                       // by id
  bool isEntry_ = false, isWhole_ = true;        // the next label is a function's first; no loop's way back is lost
};

}  // namespace

std::vector<std::uint32_t> specialised(std::span<const std::uint32_t> spirv,
                                       std::span<const Specialization> constants) {
  return Specialiser(spirv, constants).words();
}

}  // namespace importon::gpu
