/// A SPIR-V module as the blocks of its functions, for what changes their order or number.
#pragma once
#include <spirv_cross/spirv.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace importon::gpu {

using ModuleWords = std::vector<std::uint32_t>;
using Id = std::uint32_t;

/// A set of ids, which are small numbers.
class IdSet {
 public:
  /// True if it was not in there.
  bool insert(Id id) {
    if (contains(id)) return false;
    if (id >= has_.size()) has_.resize(id + std::size_t{1});
    has_[id] = true;
    ++size_;
    return true;
  }
  [[nodiscard]] bool contains(Id id) const { return id < has_.size() && has_[id]; }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  std::vector<bool> has_;
  std::size_t size_ = 0;
};

struct Instruction {
  ModuleWords words;
  SpvOp operation = SpvOpNop;
  Id type = 0, result = 0;        // 0: none
  std::vector<std::size_t> uses;  // words that are ids of values or blocks
};

/// An instruction whose operands are all ids, or none of whose others is the id of a value.
[[nodiscard]] Instruction makeInstruction(SpvOp operation, Id type, Id result, const ModuleWords& operands);

/// A block of a function: a label and what follows it.
struct Block {
  Id label = 0;
  std::vector<Instruction> instructions;
  std::vector<Id> successors;
};

struct ModuleBlocks {
  ModuleWords header;
  std::vector<Instruction> declarations;  // what stands before the first block
  std::vector<Block> blocks;              // the last of a function ends with what stands before the next one
  IdSet pointers, images;                 // types

  [[nodiscard]] Id newId();
  /// Throws std::runtime_error for a label that no block has.
  [[nodiscard]] Block& block(Id label);
  [[nodiscard]] const Block& block(Id label) const;
  [[nodiscard]] ModuleWords words() const;
};

/// Throws std::runtime_error for a module that cannot be parsed.
[[nodiscard]] ModuleBlocks blocksOf(const ModuleWords& words);

}  // namespace importon::gpu
