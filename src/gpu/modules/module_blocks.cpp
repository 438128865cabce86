#include "gpu/modules/module_blocks.h"

#include <spirv-tools/libspirv.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

namespace importon::gpu {
namespace {

constexpr std::size_t kHeaderWords = 5;
constexpr std::size_t kBoundWord = 3;  // above all ids [SPIR-V 1.5, 2.3]

bool isUse(spv_operand_type_t type) {
  return type == SPV_OPERAND_TYPE_ID || type == SPV_OPERAND_TYPE_SCOPE_ID ||
         type == SPV_OPERAND_TYPE_MEMORY_SEMANTICS_ID;
}

Instruction instructionOf(const spv_parsed_instruction_t& parsed) {
  Instruction instruction{{parsed.words, parsed.words + parsed.num_words},
                          static_cast<SpvOp>(parsed.opcode),
                          parsed.type_id,
                          parsed.result_id,
                          {}};
  for (std::uint16_t i = 0; i < parsed.num_operands; ++i)
    if (isUse(parsed.operands[i].type)) instruction.uses.push_back(parsed.operands[i].offset);
  return instruction;
}

void addSuccessors(Block& block, const Instruction& instruction) {
  switch (instruction.operation) {
    case SpvOpBranch:
      block.successors = {instruction.words[1]};
      break;
    case SpvOpBranchConditional:
      block.successors = {instruction.words[2], instruction.words[3]};
      break;
    case SpvOpSwitch:
      for (std::size_t i = 1; i < instruction.uses.size(); ++i)
        block.successors.push_back(instruction.words[instruction.uses[i]]);
      break;
    default:
      break;
  }
}

spv_result_t addInstruction(void* to, const spv_parsed_instruction_t* parsed) {
  ModuleBlocks& module = *static_cast<ModuleBlocks*>(to);
  Instruction instruction = instructionOf(*parsed);
  if (instruction.operation == SpvOpTypePointer) module.pointers.insert(instruction.result);
  if (instruction.operation == SpvOpTypeImage || instruction.operation == SpvOpTypeSampledImage)
    module.images.insert(instruction.result);
  if (instruction.operation == SpvOpLabel) module.blocks.push_back({instruction.result, {}, {}});
  if (module.blocks.empty()) {
    module.declarations.push_back(std::move(instruction));
    return SPV_SUCCESS;
  }
  addSuccessors(module.blocks.back(), instruction);
  module.blocks.back().instructions.push_back(std::move(instruction));
  return SPV_SUCCESS;
}

}  // namespace

Instruction makeInstruction(SpvOp operation, Id type, Id result, const ModuleWords& operands) {
  Instruction made{{0}, operation, type, result, {}};
  if (type != 0) made.words.push_back(type);
  if (result != 0) made.words.push_back(result);
  for (const std::uint32_t operand : operands) {
    made.uses.push_back(made.words.size());
    made.words.push_back(operand);
  }
  made.words[0] = static_cast<std::uint32_t>(made.words.size()) << SpvWordCountShift | operation;
  return made;
}

Id ModuleBlocks::newId() { return header[kBoundWord]++; }

Block& ModuleBlocks::block(Id label) {
  const auto found = std::ranges::find(blocks, label, &Block::label);
  if (found == blocks.end()) throw std::runtime_error("a branch to no block");
  return *found;
}

const Block& ModuleBlocks::block(Id label) const { return const_cast<ModuleBlocks&>(*this).block(label); }

ModuleWords ModuleBlocks::words() const {
  ModuleWords result = header;
  const auto append = [&result](const std::vector<Instruction>& instructions) {
    for (const Instruction& i : instructions) result.insert(result.end(), i.words.begin(), i.words.end());
  };
  append(declarations);
  for (const Block& each : blocks) append(each.instructions);
  return result;
}

ModuleBlocks blocksOf(const ModuleWords& words) {
  ModuleBlocks module;
  if (words.size() < kHeaderWords) throw std::runtime_error("no module");
  module.header.assign(words.begin(), words.begin() + kHeaderWords);
  const std::unique_ptr<spv_context_t, decltype(&spvContextDestroy)> context(spvContextCreate(SPV_ENV_VULKAN_1_2),
                                                                             spvContextDestroy);
  if (spvBinaryParse(context.get(), &module, words.data(), words.size(), nullptr, addInstruction, nullptr) !=
      SPV_SUCCESS)
    throw std::runtime_error("a module that cannot be parsed");
  return module;
}

}  // namespace importon::gpu
