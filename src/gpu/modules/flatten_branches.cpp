#include "gpu/modules/flatten_branches.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace importon::gpu {
namespace {

constexpr std::size_t kMostOperations = 40;  // of one side

/// Operations whose result depends on their operands alone, and that do no harm whatever these are.
bool isHarmless(SpvOp operation) {
  const auto isWithin = [operation](SpvOp first, SpvOp last) { return operation >= first && operation <= last; };
  switch (operation) {
    case SpvOpUDiv:
    case SpvOpSDiv:
    case SpvOpUMod:
    case SpvOpSRem:
    case SpvOpSMod:
      return false;
    case SpvOpExtInst:
    case SpvOpImage:
      return true;
    default:
      return isWithin(SpvOpVectorShuffle, SpvOpCompositeInsert) || isWithin(SpvOpConvertFToU, SpvOpBitcast) ||
             isWithin(SpvOpSNegate, SpvOpSMulExtended) || isWithin(SpvOpAny, SpvOpFUnordGreaterThanEqual) ||
             isWithin(SpvOpShiftRightLogical, SpvOpBitCount);
  }
}

/// A branch on a condition to two sides that meet again at once; one of them may be the meeting point itself.
struct Fork {
  Id condition, yes, no, merge;
};

class Flattener {
 public:
  explicit Flattener(ModuleBlocks& module) : module_(module) {
    for (const Block& block : module_.blocks) {
      for (const Id next : block.successors) ++parents_[next];
      for (const Instruction& i : block.instructions)
        if (i.operation == SpvOpLoopMerge) {
          ofLoops_.insert(i.words[1]);
          ofLoops_.insert(i.words[2]);
        }
    }
  }

  void run() {
    for (bool isDone = false; !isDone;) {  // a fork around a flat one may be flat then
      isDone = true;
      for (std::size_t at = 0; at < module_.blocks.size(); ++at) {
        const Fork fork = forkOf(module_.blocks[at]);
        if (!isFlat(fork)) continue;
        flatten(module_.blocks[at].label, fork);
        isDone = false;
      }
    }
  }

 private:
  static Fork forkOf(const Block& block) {
    const std::vector<Instruction>& list = block.instructions;
    if (list.size() < 2 || list.back().operation != SpvOpBranchConditional) return {};
    const Instruction& merge = list[list.size() - 2];
    if (merge.operation != SpvOpSelectionMerge) return {};
    return {list.back().words[1], list.back().words[2], list.back().words[3], merge.words[1]};
  }

  [[nodiscard]] bool isFlat(const Fork& fork) const {
    if (fork.merge == 0 || fork.yes == fork.no || parents_.at(fork.merge) != 2 || ofLoops_.contains(fork.merge))
      return false;
    if (!isFlatSide(fork.yes, fork.merge) || !isFlatSide(fork.no, fork.merge)) return false;
    return std::ranges::none_of(module_.block(fork.merge).instructions, [this](const Instruction& i) {
      return i.operation == SpvOpPhi && (module_.pointers.contains(i.type) || module_.images.contains(i.type));
    });
  }

  [[nodiscard]] bool isFlatSide(Id label, Id merge) const {
    if (label == merge) return true;
    const Block& side = module_.block(label);
    return parents_.at(label) == 1 && !ofLoops_.contains(label) && side.successors == std::vector<Id>{merge} &&
           side.instructions.size() <= kMostOperations + 2 && side.instructions.back().operation == SpvOpBranch &&
           std::all_of(side.instructions.begin() + 1, side.instructions.end() - 1,
                       [](const Instruction& i) { return isHarmless(i.operation); });
  }

  /// The fork's block goes on with both sides, the selections, and the block where they meet.
  void flatten(Id label, const Fork& fork) {
    std::vector<Instruction> joined = std::move(module_.block(label).instructions);
    joined.resize(joined.size() - 2);
    for (const Id side : {fork.yes, fork.no}) {
      if (side == fork.merge) continue;
      std::vector<Instruction>& list = module_.block(side).instructions;
      std::move(list.begin() + 1, list.end() - 1, std::back_inserter(joined));
    }
    const Id fromYes = fork.yes == fork.merge ? label : fork.yes, fromNo = fork.no == fork.merge ? label : fork.no;
    Block& merge = module_.block(fork.merge);
    for (Instruction& i : merge.instructions) {
      if (i.operation == SpvOpLabel) continue;
      joined.push_back(i.operation != SpvOpPhi
                           ? std::move(i)
                           : makeInstruction(SpvOpSelect, i.type, i.result,
                                             {fork.condition, cameFrom(i, fromYes), cameFrom(i, fromNo)}));
    }
    module_.block(label).successors = std::move(merge.successors);
    module_.block(label).instructions = std::move(joined);
    std::erase_if(module_.blocks, [&fork](const Block& block) {
      return block.label == fork.merge || block.label == fork.yes || block.label == fork.no;
    });
    rename(fork.merge, label);
  }

  static Id cameFrom(const Instruction& phi, Id parent) {
    std::size_t at = 4;
    while (phi.words[at] != parent) at += 2;
    return phi.words[at - 1];
  }

  /// In phis, which come first in a block: what came from one block comes from the other.
  void rename(Id from, Id to) {
    for (Block& block : module_.blocks) {
      for (auto i = block.instructions.begin() + 1; i != block.instructions.end() && i->operation == SpvOpPhi; ++i)
        for (std::size_t parent = 4; parent < i->words.size(); parent += 2)
          if (i->words[parent] == from) i->words[parent] = to;
    }
  }

  ModuleBlocks& module_;
  std::map<Id, int> parents_;  // by label: blocks that branch to it
  IdSet ofLoops_;              // where loops end or go on
};

}  // namespace

void flattenBranches(ModuleBlocks& module) { Flattener(module).run(); }

}  // namespace importon::gpu
