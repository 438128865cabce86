#include "gpu/storage_texels.h"

#include <algorithm>
#include <initializer_list>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "gpu/spirv_words.h"

namespace importon::gpu {
namespace {

using Id = std::uint32_t;
using Words = std::vector<std::uint32_t>;
using Instruction = SpirvInstruction;

template <class Function>
void forEach(std::span<const std::uint32_t> module, Function&& function) {
  if (!forEachInstruction(module, function)) throw std::logic_error("an instruction ends beyond its module");
}

void append(Words& words, SpvOp operation, std::initializer_list<std::uint32_t> operands) {
  words.push_back(static_cast<std::uint32_t>(operands.size() + 1) << SpvWordCountShift | operation);
  words.insert(words.end(), operands);
}

bool isType(SpvOp operation) { return operation >= SpvOpTypeVoid && operation <= SpvOpTypeForwardPointer; }

/// Items of a storage buffer: `words` of type `scalar`.
struct Item {
  Id scalar;
  std::uint32_t words;
  auto operator<=>(const Item&) const = default;
};

/// Ids of the types of a storage buffer of such items.
struct ItemTypes {
  Id item, array, block, blockPointer, itemPointer;
};

class Rewriter {
 public:
  Rewriter(std::span<const std::uint32_t> module, std::span<const KernelBuffer> buffers)
      : module_(module), bound_(module[kSpirvBoundWord]) {
    forEach(module, [this](Instruction i) { read(i); });
    if (variables_.empty()) return;
    for (const auto& [variable, scalar] : variables_) itemOf_[variable] = {scalar, texelWords(buffers, variable)};
    for (const auto& [variable, item] : itemOf_) types_.try_emplace(item, ItemTypes{});
    for (auto& [item, types] : types_)
      types = {itemType(item), bound_, bound_ + 1, bound_ + 2, bound_ + 3}, bound_ += 4;
    zero_ = bound_++;
    if (uint_ == 0) throw std::logic_error("a module reads texels and has no unsigned integers");
  }

  Words rewritten() {
    if (variables_.empty()) return {module_.begin(), module_.end()};
    Words result(module_.begin(), module_.begin() + kSpirvHeaderWords);
    bool isDecorated = false, isDeclared = false;
    forEach(module_, [&](Instruction i) {
      if (isType(operationOf(i)) && !std::exchange(isDecorated, true)) decorate(result);
      if (operationOf(i) == SpvOpFunction && !std::exchange(isDeclared, true)) declare(result);
      write(result, i);
    });
    result[kSpirvBoundWord] = bound_;
    return result;
  }

 private:
  /// Notes what declares texel buffers, and the types that their items have.
  void read(Instruction i) {
    switch (operationOf(i)) {
      case SpvOpDecorate:
        if (i[2] == SpvDecorationBinding) bindings_[i[1]] = i[3];
        break;
      case SpvOpTypeInt:
        if (i[2] == 32 && i[3] == 0) uint_ = i[1];
        break;
      case SpvOpTypeVector:
        vectors_[{i[2], i[3]}] = i[1];
        break;
      case SpvOpTypeImage:
        if (i[3] == SpvDimBuffer) scalars_[i[1]] = i[2];
        break;
      case SpvOpTypeSampledImage:
        if (scalars_.contains(i[2])) scalars_[i[1]] = scalars_[i[2]];
        break;
      case SpvOpTypePointer:
        if (scalars_.contains(i[3])) scalars_[i[1]] = scalars_[i[3]];
        break;
      case SpvOpVariable:
        if (scalars_.contains(i[1])) variables_[i[2]] = scalars_[i[1]];
        break;
      default:
        break;
    }
  }

  std::uint32_t texelWords(std::span<const KernelBuffer> buffers, Id variable) const {
    const auto binding = bindings_.find(variable);
    const auto found = std::ranges::find_if(buffers, [&](const KernelBuffer& buffer) {
      return binding != bindings_.end() && buffer.slot == binding->second && buffer.texelWords > 0;
    });
    if (found == buffers.end()) throw std::logic_error("a module has a texel buffer that its description has not");
    return found->texelWords;
  }

  Id itemType(const Item& item) {
    if (item.words == 1) return item.scalar;
    Id& vector = vectors_[{item.scalar, item.words}];
    if (vector == 0) {
      vector = bound_++;
      append(newVectors_, SpvOpTypeVector, {vector, item.scalar, item.words});
    }
    return vector;
  }

  void decorate(Words& to) const {
    for (const auto& [item, types] : types_) {
      append(to, SpvOpDecorate, {types.array, SpvDecorationArrayStride, 4 * item.words});
      append(to, SpvOpDecorate, {types.block, SpvDecorationBlock});
      append(to, SpvOpMemberDecorate, {types.block, 0, SpvDecorationOffset, 0});
      append(to, SpvOpMemberDecorate, {types.block, 0, SpvDecorationNonWritable});
    }
  }

  void declare(Words& to) const {
    to.insert(to.end(), newVectors_.begin(), newVectors_.end());
    append(to, SpvOpConstant, {uint_, zero_, 0});
    for (const auto& [item, types] : types_) {
      append(to, SpvOpTypeRuntimeArray, {types.array, types.item});
      append(to, SpvOpTypeStruct, {types.block, types.array});
      append(to, SpvOpTypePointer, {types.blockPointer, SpvStorageClassStorageBuffer, types.block});
      append(to, SpvOpTypePointer, {types.itemPointer, SpvStorageClassStorageBuffer, types.item});
    }
    for (const auto& [variable, item] : itemOf_)
      append(to, SpvOpVariable, {types_.at(item).blockPointer, variable, SpvStorageClassStorageBuffer});
  }

  /// The instruction, unless it is of a texel buffer: then what stands in its place, if anything.
  void write(Words& to, Instruction i) {
    const SpvOp operation = operationOf(i);
    const bool ofTexels = i.size() > 2 && scalars_.contains(i[1]);
    if (operation == SpvOpImageFetch) return fetch(to, i);
    if (operation == SpvOpImageQuerySize) return count(to, i);
    if (ofTexels && (operation == SpvOpLoad || operation == SpvOpImage)) {
      const auto loaded = images_.find(i[3]);
      images_[i[2]] = loaded == images_.end() ? i[3] : loaded->second;
      return;
    }
    const bool declares = ofTexels && (isType(operation) || operation == SpvOpVariable || operation == SpvOpName);
    const bool asks = operation == SpvOpCapability && i[1] == SpvCapabilitySampledBuffer;
    if (!declares && !asks) to.insert(to.end(), i.begin(), i.end());
  }

  /// A texel has four components; those that an item lacks are never read.
  void fetch(Words& to, Instruction i) {
    const Id texel = i[2], variable = images_.at(i[3]), index = i[4];
    const auto& [scalar, words] = itemOf_.at(variable);
    const ItemTypes& types = types_.at({scalar, words});
    const Id pointer = bound_++, item = words == 4 ? texel : bound_++;
    append(to, SpvOpAccessChain, {types.itemPointer, pointer, variable, zero_, index});
    append(to, SpvOpLoad, {types.item, item, pointer});
    if (words == 1) append(to, SpvOpCompositeConstruct, {i[1], texel, item, item, item, item});
    if (words == 2) append(to, SpvOpCompositeConstruct, {i[1], texel, item, item});
  }

  void count(Words& to, Instruction i) {
    const Id length = bound_++;
    append(to, SpvOpArrayLength, {uint_, length, images_.at(i[3]), 0});
    append(to, SpvOpBitcast, {i[1], i[2], length});
  }

  std::span<const std::uint32_t> module_;
  Id bound_, zero_ = 0, uint_ = 0;
  std::map<Id, std::uint32_t> bindings_;
  std::map<std::pair<Id, std::uint32_t>, Id> vectors_;  // by scalar and size
  Words newVectors_;
  std::map<Id, Id> scalars_;    // of what a texel has, by its types: image, sampled image, pointer
  std::map<Id, Id> variables_;  // the texel buffers, with their scalars
  std::map<Id, Item> itemOf_;   // by variable
  std::map<Item, ItemTypes> types_;
  std::map<Id, Id> images_;  // variables, by what was loaded of them
};

}  // namespace

std::vector<std::uint32_t> storageTexels(std::span<const std::uint32_t> spirv, std::span<const KernelBuffer> buffers) {
  return Rewriter(spirv, buffers).rewritten();
}

}  // namespace importon::gpu
