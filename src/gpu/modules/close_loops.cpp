#include "gpu/modules/close_loops.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

namespace importon::gpu {
namespace {

struct Loop {
  Id header = 0, merge = 0;
  IdSet members;  // labels
};

/// Blocks that are reached from the header without leaving by the merge block.
IdSet membersOf(const ModuleBlocks& module, Id header, Id merge) {
  IdSet members;
  members.insert(header);
  std::vector<Id> open{header};
  while (!open.empty()) {
    const Id label = open.back();
    open.pop_back();
    for (const Id next : module.block(label).successors)
      if (next != merge && members.insert(next)) open.push_back(next);
  }
  return members;
}

/// Inner ones before those around them.
std::vector<Loop> loopsOf(const ModuleBlocks& module) {
  std::vector<Loop> loops;
  for (const Block& block : module.blocks)
    for (const Instruction& instruction : block.instructions)
      if (instruction.operation == SpvOpLoopMerge)
        loops.push_back({block.label, instruction.words[1], membersOf(module, block.label, instruction.words[1])});
  std::ranges::stable_sort(loops, {}, [](const Loop& loop) { return loop.members.size(); });
  return loops;
}

/// Calls `visit(word)` for each use of a value outside the loop; a phi uses a value where it comes from.
template <class Visit>
void forUsesOutside(ModuleBlocks& module, const Loop& loop, Visit&& visit) {
  for (Block& block : module.blocks) {
    const bool isInside = loop.members.contains(block.label);
    for (Instruction& instruction : block.instructions) {
      const bool isPhi = instruction.operation == SpvOpPhi;
      if (isInside && !isPhi) continue;
      for (const std::size_t use : instruction.uses) {
        const bool isParent = isPhi && (use - 3) % 2 == 1;
        const bool isFromInside = isPhi && !isParent && loop.members.contains(instruction.words[use + 1]);
        if (!isParent && !isFromInside) visit(instruction.words[use]);
      }
    }
  }
}

bool readsMemory(SpvOp operation) {
  return operation == SpvOpLoad || operation == SpvOpImageFetch ||
         (operation >= SpvOpAtomicLoad && operation <= SpvOpAtomicXor);
}

/// Values of the loop that depend on what is read in it: a turn in which a lane has no part reads something else for
/// it. Others come out of the header's phis again, turn by turn.
IdSet readIn(const ModuleBlocks& module, const Loop& loop) {
  IdSet values;
  for (std::size_t before = 1; before != values.size();) {  // until no phi adds any
    before = values.size();
    for (const Block& block : module.blocks) {
      if (!loop.members.contains(block.label)) continue;
      for (const Instruction& i : block.instructions) {
        const bool isHeld = i.operation == SpvOpPhi && block.label == loop.header;
        if (i.type == 0 || isHeld || module.images.contains(i.type)) continue;
        const auto isRead = [&](std::size_t use) { return values.contains(i.words[use]); };
        if (readsMemory(i.operation) || std::ranges::any_of(i.uses, isRead)) values.insert(i.result);
      }
    }
  }
  return values;
}

class Closer {
 public:
  explicit Closer(ModuleBlocks& module) : module_(module) {}

  void close(const Loop& loop) {
    const std::vector<std::pair<Id, Id>> leaving = leavingValues(loop);
    if (leaving.empty()) return;
    const std::vector<Id> parents = parentsOf(loop.merge);
    for (const auto& [value, type] : leaving) {
      const Id closed = module_.newId();
      forUsesOutside(module_, loop, [&, value = value](Id& id) { id = id == value ? closed : id; });
      ModuleWords operands;
      for (const Id parent : parents) operands.insert(operands.end(), {value, parent});
      Block& merge = module_.block(loop.merge);
      merge.instructions.insert(merge.instructions.begin() + 1, makeInstruction(SpvOpPhi, type, closed, operands));
    }
    addExit(loop);
  }

 private:
  /// All values that leave the loop, with their types; none if none of them depends on what is read in it.
  std::vector<std::pair<Id, Id>> leavingValues(const Loop& loop) {
    const IdSet read = readIn(module_, loop);
    IdSet usedAfter;
    forUsesOutside(module_, loop, [&](Id& id) { usedAfter.insert(id); });
    std::vector<std::pair<Id, Id>> leaving;
    bool isRead = false;
    for (const Block& each : module_.blocks) {
      if (!loop.members.contains(each.label)) continue;
      for (const Instruction& i : each.instructions) {
        if (i.type == 0 || module_.images.contains(i.type) || !usedAfter.contains(i.result)) continue;
        leaving.emplace_back(i.result, i.type);
        isRead |= read.contains(i.result);
      }
    }
    if (!isRead) return {};
    for (const auto& [value, type] : leaving)
      if (module_.pointers.contains(type)) throw std::runtime_error("a pointer leaves a loop");
    return leaving;
  }

  std::vector<Id> parentsOf(Id label) const {
    std::vector<Id> parents;
    for (const Block& each : module_.blocks)
      if (std::ranges::find(each.successors, label) != each.successors.end()) parents.push_back(each.label);
    return parents;
  }

  /// A second way out of the loop that is never taken: an optimiser would take a phi for its only value.
  void addExit(const Loop& loop) {
    const Id rest = module_.newId(), never = neverTrue();
    Block& header = module_.block(loop.header);
    Block body{rest, {makeInstruction(SpvOpLabel, 0, rest, {})}, header.successors};
    std::vector<Instruction> kept;
    Instruction merge;
    for (Instruction& i : header.instructions) {
      const bool isKept = i.operation == SpvOpLabel || i.operation == SpvOpPhi;
      if (i.operation == SpvOpLoopMerge)
        merge = std::move(i);
      else
        (isKept ? kept : body.instructions).push_back(std::move(i));
    }
    if (merge.words[2] == loop.header) merge.words[2] = rest;  // a loop of one block
    kept.push_back(std::move(merge));
    kept.push_back(makeInstruction(SpvOpBranchConditional, 0, 0, {never, loop.merge, rest}));
    header.instructions = std::move(kept);
    header.successors = {loop.merge, rest};
    module_.blocks.insert(std::ranges::find(module_.blocks, loop.header, &Block::label) + 1, std::move(body));
    moveParent(loop, rest);
  }

  /// Phis after the header's end come from `rest` now, and those of the merge block from the header too.
  void moveParent(const Loop& loop, Id rest) {
    for (Block& each : module_.blocks) {
      for (Instruction& i : each.instructions) {
        if (i.operation != SpvOpPhi) continue;
        for (std::size_t parent = 4; parent < i.words.size(); parent += 2)
          if (i.words[parent] == loop.header) i.words[parent] = rest;
        if (each.label != loop.merge) continue;
        ModuleWords operands(i.words.begin() + 3, i.words.end());
        operands.insert(operands.end(), {zero(i.type), loop.header});
        i = makeInstruction(SpvOpPhi, i.type, i.result, operands);
      }
    }
  }

  Id zero(Id type) {
    Id& id = zeros_[type];
    if (id == 0) {
      id = module_.newId();
      module_.declarations.insert(functions(), makeInstruction(SpvOpConstantNull, type, id, {}));
    }
    return id;
  }

  /// A value that is false and that no optimiser knows: a dispatch without workgroups.
  Id neverTrue() {
    if (never_ != 0) return never_;
    const Id counts = module_.newId(), count = module_.newId();
    never_ = module_.newId();
    const Instruction variable = workgroupCounts();
    const Id vector = declared([&](const Instruction& i) {
                        return i.operation == SpvOpTypePointer && i.result == variable.type;
                      }).words[3];
    const Id scalar =
        declared([&](const Instruction& i) { return i.operation == SpvOpTypeVector && i.result == vector; }).words[2];
    const Id boolean = declared([](const Instruction& i) { return i.operation == SpvOpTypeBool; }).result;
    std::vector<Instruction>& first = module_.blocks.front().instructions;
    const auto at = std::ranges::find_if(
        first, [](const Instruction& i) { return i.operation != SpvOpLabel && i.operation != SpvOpVariable; });
    const Id zeroCount = zero(scalar);
    first.insert(at, {makeInstruction(SpvOpLoad, vector, counts, {variable.result}),
                      makeInstruction(SpvOpCompositeExtract, scalar, count, {counts, 0}),
                      makeInstruction(SpvOpIEqual, boolean, never_, {count, zeroCount})});
    return never_;
  }

  const Instruction& workgroupCounts() const {
    const Id id = declared([](const Instruction& i) {
                    return i.operation == SpvOpDecorate && i.words[2] == SpvDecorationBuiltIn &&
                           i.words[3] == SpvBuiltInNumWorkgroups;
                  }).words[1];
    return declared([id](const Instruction& i) { return i.operation == SpvOpVariable && i.result == id; });
  }

  template <class Is>
  const Instruction& declared(Is&& is) const {
    const auto found = std::ranges::find_if(module_.declarations, is);
    if (found == module_.declarations.end())
      throw std::runtime_error("a value that is read in a loop leaves it, and there is no gl_NumWorkGroups");
    return *found;
  }

  std::vector<Instruction>::iterator functions() {
    return std::ranges::find(module_.declarations, SpvOpFunction, &Instruction::operation);
  }

  ModuleBlocks& module_;
  Id never_ = 0;
  std::map<Id, Id> zeros_;  // by type
};

}  // namespace

void closeLoops(ModuleBlocks& module) {
  Closer closer(module);
  for (const Loop& loop : loopsOf(module))
    closer.close({loop.header, loop.merge, membersOf(module, loop.header, loop.merge)});  // closing adds members
}

}  // namespace importon::gpu
