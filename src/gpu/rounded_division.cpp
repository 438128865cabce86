#include "gpu/rounded_division.h"

#include <spirv_cross/GLSL.std.450.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "gpu/rounding_words.h"
#include "gpu/spirv_words.h"

namespace importon::gpu {
namespace {

using Id = std::uint32_t;
using Words = std::vector<std::uint32_t>;
using Instruction = SpirvInstruction;

constexpr std::uint32_t kLibraryName[] = {0x4C534C47, 0x6474732E, 0x3035342E, 0};  // "GLSL.std.450"

bool isConstant(SpvOp operation) { return operation >= SpvOpConstantTrue && operation <= SpvOpConstantNull; }

/// Where ids stand in an instruction of the functions' module, which has no others than these with literals.
std::vector<std::size_t> idsOf(Instruction i) {
  std::set<std::size_t> literals;
  switch (operationOf(i)) {
    case SpvOpTypeInt:
      literals = {2, 3};
      break;
    case SpvOpTypeFloat:
    case SpvOpTypePointer:
    case SpvOpSelectionMerge:
      literals = {2};
      break;
    case SpvOpConstant:
    case SpvOpFunction:
    case SpvOpVariable:
    case SpvOpLoopMerge:
      literals = {3};
      break;
    case SpvOpExtInst:
      literals = {4};
      break;
    default:
      break;
  }
  std::vector<std::size_t> ids;
  for (std::size_t k = 1; k < i.size(); ++k)
    if (!literals.contains(k)) ids.push_back(k);
  return ids;
}

/// What tells a type from others: its words but its own id.
Words keyOf(Instruction type) {
  Words key(type.begin(), type.end());
  key.erase(key.begin() + 1);
  return key;
}

/// The functions of rounding.comp, but for main, as part of another module.
class Functions {
 public:
  /// `bound`: above all ids of the module, and then of the functions too. `types`: those of the module, by their words
  /// without their own id. `library`: its GLSL.std.450.
  Functions(std::map<Words, Id> types, Id library, Id& bound) : types_(std::move(types)), bound_(bound) {
    forEachInstruction(kRoundingModule, [this](Instruction i) {
      if (operationOf(i) == SpvOpEntryPoint) main_ = i[2];
      if (operationOf(i) == SpvOpName) note(i);
    });
    forEachInstruction(kRoundingModule, [this, library](Instruction i) {
      if (operationOf(i) == SpvOpExtInstImport) ids_[i[1]] = library;
      if (declaresType(operationOf(i)) || isConstant(operationOf(i))) declare(i);
      if (operationOf(i) == SpvOpFunction) isInMain_ = i[2] == main_;
      isInFunctions_ |= operationOf(i) == SpvOpFunction;
      if (!isInFunctions_ || isInMain_) return;
      const Words words = renamedWords(i);
      bodies_.insert(bodies_.end(), words.begin(), words.end());
    });
  }

  [[nodiscard]] const Words& declarations() const { return declarations_; }
  [[nodiscard]] const Words& bodies() const { return bodies_; }
  [[nodiscard]] Id quotient() { return renamed(quotient_); }
  [[nodiscard]] Id root() { return renamed(root_); }

 private:
  void note(Instruction i) {
    const std::string_view name(reinterpret_cast<const char*>(&i[2]));
    if (name.starts_with("roundedQuotient(")) quotient_ = i[1];
    if (name.starts_with("roundedRoot(")) root_ = i[1];
  }

  Id renamed(Id id) {
    Id& to = ids_[id];
    if (to == 0) to = bound_++;
    return to;
  }

  /// Types but pointers must not be there twice. [SPIR-V 1.5, 2.8]
  void declare(Instruction i) {
    const Id before = bound_;
    const Words words = renamedWords(i);
    const auto known = types_.find(keyOf(words));
    if (!declaresType(operationOf(i)) || operationOf(i) == SpvOpTypePointer || known == types_.end()) {
      declarations_.insert(declarations_.end(), words.begin(), words.end());
      if (declaresType(operationOf(i))) types_[keyOf(words)] = words[1];
      return;
    }
    bound_ = before;  // its new id is not used
    ids_[i[1]] = known->second;
  }

  Words renamedWords(Instruction i) {
    Words words(i.begin(), i.end());
    for (const std::size_t at : idsOf(i)) words[at] = renamed(words[at]);
    return words;
  }

  std::map<Words, Id> types_;
  Id& bound_;
  std::map<Id, Id> ids_;  // in the other module, by those in this one
  Id main_ = 0, quotient_ = 0, root_ = 0;
  bool isInMain_ = false, isInFunctions_ = false;
  Words declarations_, bodies_;
};

class Divider {
 public:
  explicit Divider(std::span<const std::uint32_t> module) : module_(module), bound_(module[kSpirvBoundWord]) {
    forEachInstruction(module, [this](Instruction i) { read(i); });
  }

  Words rewritten() {
    if (library_ == 0) {  // no roots, and no name for the functions' own
      library_ = bound_++;
      addsLibrary_ = true;
    }
    Functions functions(types_, library_, bound_);
    quotient_ = functions.quotient();
    root_ = functions.root();
    Words result(module_.begin(), module_.begin() + kSpirvHeaderWords);
    bool isDeclared = false;
    forEachInstruction(module_, [&](Instruction i) {
      if (operationOf(i) == SpvOpMemoryModel && addsLibrary_)
        appendInstruction(result, SpvOpExtInstImport,
                          {library_, kLibraryName[0], kLibraryName[1], kLibraryName[2], kLibraryName[3]});
      if (operationOf(i) == SpvOpFunction && !std::exchange(isDeclared, true))
        result.insert(result.end(), functions.declarations().begin(), functions.declarations().end());
      write(result, i);
    });
    result.insert(result.end(), functions.bodies().begin(), functions.bodies().end());
    result[kSpirvBoundWord] = bound_;
    return result;
  }

 private:
  void read(Instruction i) {
    const SpvOp operation = operationOf(i);
    if (operation == SpvOpExtInstImport && std::ranges::equal(i.subspan(2), kLibraryName)) library_ = i[1];
    if (operation == SpvOpFDiv) quotients_.insert(i[2]);
    if (!declaresType(operation)) return;
    types_[keyOf(i)] = i[1];
    if (operation == SpvOpTypeVector) vectors_[i[1]] = {i[2], i[3]};
  }

  void write(Words& to, Instruction i) {
    if (operationOf(i) == SpvOpFDiv) return call(to, quotient_, i[1], i[2], i.subspan(3));
    if (operationOf(i) == SpvOpExtInst && i[3] == library_ && i[4] == GLSLstd450Sqrt)
      return call(to, root_, i[1], i[2], i.subspan(5));
    // Calls take no decoration of arithmetic.
    if (operationOf(i) == SpvOpDecorate && i[2] == SpvDecorationNoContraction && quotients_.contains(i[1])) return;
    to.insert(to.end(), i.begin(), i.end());
  }

  /// A call for each component.
  void call(Words& to, Id function, Id type, Id result, std::span<const std::uint32_t> operands) {
    const auto vector = vectors_.find(type);
    if (vector == vectors_.end()) return callScalar(to, function, type, result, {operands.begin(), operands.end()});
    const auto [scalar, count] = vector->second;
    Words construct{type, result};
    for (std::uint32_t k = 0; k < count; ++k) {
      Words components;
      for (const Id operand : operands) {
        components.push_back(bound_++);
        appendInstruction(to, SpvOpCompositeExtract, {scalar, components.back(), operand, k});
      }
      construct.push_back(bound_++);
      callScalar(to, function, scalar, construct.back(), components);
    }
    appendInstruction(to, SpvOpCompositeConstruct, construct);
  }

  static void callScalar(Words& to, Id function, Id type, Id result, const Words& operands) {
    Words words{type, result, function};
    words.insert(words.end(), operands.begin(), operands.end());
    appendInstruction(to, SpvOpFunctionCall, words);
  }

  std::span<const std::uint32_t> module_;
  Id bound_, library_ = 0, quotient_ = 0, root_ = 0;
  bool addsLibrary_ = false;
  std::map<Words, Id> types_;                           // by their words without their own id
  std::map<Id, std::pair<Id, std::uint32_t>> vectors_;  // component and count
  std::set<Id> quotients_;
};

}  // namespace

std::vector<std::uint32_t> roundedDivision(std::span<const std::uint32_t> spirv) { return Divider(spirv).rewritten(); }

}  // namespace importon::gpu
