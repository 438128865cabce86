#include "gpu/modules/portable_arithmetic.h"

#include <spirv_cross/GLSL.std.450.h>

#include <algorithm>
#include <bit>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "gpu/spirv_words.h"

namespace importon::gpu {
namespace {

/// A type of one or more floats, or of columns of them.
struct FloatType {
  Id component;         // itself, if a scalar
  std::uint32_t count;  // components or columns
};

/// Types and constants of a module, with those that are asked for and that it lacks.
class Declarations {
 public:
  explicit Declarations(ModuleBlocks& module) : module_(module) {
    for (const Instruction& i : module_.declarations) read(i);
  }

  [[nodiscard]] Id library() const { return library_; }
  [[nodiscard]] Id floatType() const { return float_; }
  [[nodiscard]] Id uintType() { return scalar(uint_, SpvOpTypeInt, {32, 0}); }
  [[nodiscard]] Id intType() { return scalar(int_, SpvOpTypeInt, {32, 1}); }
  [[nodiscard]] Id boolType() { return scalar(bool_, SpvOpTypeBool, {}); }
  [[nodiscard]] FloatType type(Id id) const { return types_.at(id); }

  [[nodiscard]] Id number(float value) { return constant(float_, std::bit_cast<std::uint32_t>(value)); }
  [[nodiscard]] Id word(std::uint32_t value) { return constant(uintType(), value); }

  /// All components are `value`.
  [[nodiscard]] Id numbers(Id type, float value) {
    const Id component = number(value);
    const std::uint32_t count = types_.at(type).count;
    if (count == 1) return component;
    Id& id = constants_[{type, component}];
    if (id == 0) {
      id = module_.newId();
      added_.push_back(makeInstruction(SpvOpConstantComposite, type, id, ModuleWords(count, component)));
    }
    return id;
  }

  void write(const std::vector<Instruction>& decorations) {
    const auto functions = std::ranges::find(module_.declarations, SpvOpFunction, &Instruction::operation);
    module_.declarations.insert(functions, added_.begin(), added_.end());
    const auto types =
        std::ranges::find_if(module_.declarations, [](const Instruction& i) { return declaresType(i.operation); });
    module_.declarations.insert(types, decorations.begin(), decorations.end());
  }

 private:
  void read(const Instruction& i) {
    const ModuleWords& w = i.words;
    if (i.operation == SpvOpExtInstImport) library_ = w[1];
    if (i.operation == SpvOpTypeBool) bool_ = w[1];
    if (i.operation == SpvOpTypeInt && w[2] == 32) (w[3] == 0 ? uint_ : int_) = w[1];
    if (i.operation == SpvOpTypeFloat && w[2] == 32) {
      float_ = w[1];
      types_[w[1]] = {w[1], 1};
    }
    if ((i.operation == SpvOpTypeVector || i.operation == SpvOpTypeMatrix) && types_.contains(w[2]))
      types_[w[1]] = {w[2], w[3]};
  }

  Id scalar(Id& id, SpvOp operation, const ModuleWords& operands) {
    if (id == 0) {
      id = module_.newId();
      added_.push_back(makeInstruction(operation, 0, id, operands));
    }
    return id;
  }

  Id constant(Id type, std::uint32_t bits) {
    Id& id = constants_[{type, bits}];
    if (id == 0) {
      id = module_.newId();
      added_.push_back(makeInstruction(SpvOpConstant, type, id, {bits}));
    }
    return id;
  }

  ModuleBlocks& module_;
  std::vector<Instruction> added_;
  Id library_ = 0, float_ = 0, uint_ = 0, int_ = 0, bool_ = 0;
  std::map<Id, FloatType> types_;
  std::map<std::pair<Id, std::uint32_t>, Id> constants_;  // by type, and bits or component
};

/// Functions that have one result only.
bool isExact(std::uint32_t function) {
  switch (function) {
    case GLSLstd450FAbs:
    case GLSLstd450SAbs:
    case GLSLstd450FSign:
    case GLSLstd450SSign:
    case GLSLstd450Floor:
    case GLSLstd450Ceil:
    case GLSLstd450Trunc:
    case GLSLstd450RoundEven:
    case GLSLstd450FMin:
    case GLSLstd450UMin:
    case GLSLstd450SMin:
    case GLSLstd450FMax:
    case GLSLstd450UMax:
    case GLSLstd450SMax:
    case GLSLstd450FClamp:
    case GLSLstd450UClamp:
    case GLSLstd450SClamp:
    case GLSLstd450FindILsb:
    case GLSLstd450FindSMsb:
    case GLSLstd450FindUMsb:
    case GLSLstd450UnpackHalf2x16:
    case GLSLstd450Sqrt:
      return true;
    default:
      return false;
  }
}

class Rewriter {
 public:
  explicit Rewriter(ModuleBlocks& module) : module_(module), declarations_(module) {
    for (const Instruction& i : module_.declarations)
      if (i.type != 0 && i.result != 0) typeOf_[i.result] = i.type;
  }

  void run() {
    for (Block& block : module_.blocks) {
      const std::vector<Instruction> before = std::exchange(block.instructions, {});
      to_ = &block.instructions;
      for (const Instruction& i : before) rewrite(i);
    }
    declarations_.write(decorations_);
  }

 private:
  [[nodiscard]] Id floatType() const { return declarations_.floatType(); }

  void rewrite(const Instruction& i) {
    const ModuleWords& w = i.words;
    switch (i.operation) {
      case SpvOpDot:
        sumOfProducts(i.result, components(w[3]), components(w[4]));
        return;
      case SpvOpVectorTimesMatrix: {
        std::vector<Id> sums;
        for (std::uint32_t c = 0; c < declarations_.type(i.type).count; ++c)
          sums.push_back(sumOfProducts(0, components(w[3]), column(w[4], c)));
        add(SpvOpCompositeConstruct, i.type, sums, i.result);
        return;
      }
      case SpvOpMatrixTimesVector: {
        std::vector<Id> sums;
        for (std::uint32_t r = 0; r < declarations_.type(i.type).count; ++r)
          sums.push_back(sumOfProducts(0, row(w[3], r), components(w[4])));
        add(SpvOpCompositeConstruct, i.type, sums, i.result);
        return;
      }
      case SpvOpFRem:
      case SpvOpFMod:
      case SpvOpMatrixTimesMatrix:
      case SpvOpMatrixTimesScalar:
      case SpvOpOuterProduct:
        throw std::runtime_error("an operation on floats without a portable form: " + std::to_string(i.operation));
      case SpvOpExtInst:
        if (w[3] == declarations_.library()) return rewriteCall(i);
        break;
      default:
        break;
    }
    keep(i);
  }

  void rewriteCall(const Instruction& i) {
    const ModuleWords& w = i.words;
    const Id type = i.type, result = i.result, x = w.at(5);
    if (isExact(w[4])) return keep(i);
    switch (w[4]) {
      case GLSLstd450Round:  // leaves halves open
        call(GLSLstd450RoundEven, type, {x}, result);
        return;
      case GLSLstd450Fract:
        add(SpvOpFSub, type, {x, call(GLSLstd450Floor, type, {x})}, result);
        return;
      case GLSLstd450FMix: {
        const Id first = add(SpvOpFMul, type, {x, add(SpvOpFSub, type, {declarations_.numbers(type, 1), w[7]})});
        add(SpvOpFAdd, type, {first, add(SpvOpFMul, type, {w[6], w[7]})}, result);
        return;
      }
      case GLSLstd450Cross:
        return cross(i);
      case GLSLstd450Length:
        call(GLSLstd450Sqrt, type, {squareOf(x)}, result);
        return;
      case GLSLstd450Distance:
        call(GLSLstd450Sqrt, type, {squareOf(add(SpvOpFSub, typeOf_.at(x), {x, w[6]}))}, result);
        return;
      case GLSLstd450Normalize:
        return normalize(i);
      case GLSLstd450Reflect: {
        const Id cosine = sumOfProducts(0, components(x), components(w[6]));
        const Id twice = add(SpvOpFAdd, floatType(), {cosine, cosine});
        add(SpvOpFSub, type, {x, add(SpvOpVectorTimesScalar, type, {w[6], twice})}, result);
        return;
      }
      case GLSLstd450InverseSqrt:
        add(SpvOpFDiv, type, {declarations_.numbers(type, 1), call(GLSLstd450Sqrt, type, {x})}, result);
        return;
      case GLSLstd450UnpackUnorm2x16:
        return unpack(i, 16, false);
      case GLSLstd450UnpackUnorm4x8:
        return unpack(i, 8, false);
      case GLSLstd450UnpackSnorm2x16:
        return unpack(i, 16, true);
      default:
        throw std::runtime_error("a function of floats without a portable form: GLSL.std.450 " + std::to_string(w[4]));
    }
  }

  Id sumOfProducts(Id result, const std::vector<Id>& a, const std::vector<Id>& b) {
    Id sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
      const Id product = add(SpvOpFMul, floatType(), {a[k], b[k]});
      sum = k == 0 ? product : add(SpvOpFAdd, floatType(), {sum, product}, k + 1 == a.size() ? result : 0);
    }
    return sum;
  }

  Id squareOf(Id x) {
    const std::vector<Id> all = components(x);
    return all.size() == 1 ? add(SpvOpFMul, floatType(), {x, x}) : sumOfProducts(0, all, all);
  }

  void cross(const Instruction& i) {
    const std::vector<Id> a = components(i.words[5]), b = components(i.words[6]);
    std::vector<Id> differences;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t m = (k + 1) % 3, n = (k + 2) % 3;
      differences.push_back(
          add(SpvOpFSub, floatType(),
              {add(SpvOpFMul, floatType(), {a[m], b[n]}), add(SpvOpFMul, floatType(), {a[n], b[m]})}));
    }
    add(SpvOpCompositeConstruct, i.type, differences, i.result);
  }

  /// A vector of length 0 stays as it is.
  void normalize(const Instruction& i) {
    const Id square = squareOf(i.words[5]), one = declarations_.number(1);
    const Id inverse = add(SpvOpFDiv, floatType(), {one, call(GLSLstd450Sqrt, floatType(), {square})});
    const Id isLong = add(SpvOpFOrdGreaterThan, declarations_.boolType(), {square, declarations_.number(0)});
    add(SpvOpVectorTimesScalar, i.type, {i.words[5], add(SpvOpSelect, floatType(), {isLong, inverse, one})}, i.result);
  }

  /// Fractions of the largest integer, by its reciprocal. [Vulkan 1.2, 3.10 asks for c / (2^b - 1), within rounding]
  void unpack(const Instruction& i, std::uint32_t bits, bool isSigned) {
    const Id integer = isSigned ? declarations_.intType() : declarations_.uintType();
    const Id word = isSigned ? add(SpvOpBitcast, integer, {i.words[5]}) : i.words[5];
    const float largest = static_cast<float>((1u << (isSigned ? bits - 1 : bits)) - 1);
    std::vector<Id> fractions;
    for (std::uint32_t at = 0; at < 32; at += bits) {
      const Id part = add(isSigned ? SpvOpBitFieldSExtract : SpvOpBitFieldUExtract, integer,
                          {word, declarations_.word(at), declarations_.word(bits)});
      Id value = add(isSigned ? SpvOpConvertSToF : SpvOpConvertUToF, floatType(), {part});
      value = add(SpvOpFMul, floatType(), {value, declarations_.number(1 / largest)});
      fractions.push_back(isSigned ? call(GLSLstd450FMax, floatType(), {value, declarations_.number(-1)}) : value);
    }
    add(SpvOpCompositeConstruct, i.type, fractions, i.result);
  }

  std::vector<Id> components(Id value) {
    const FloatType type = declarations_.type(typeOf_.at(value));
    std::vector<Id> result;
    for (std::uint32_t k = 0; k < type.count; ++k) result.push_back(type.count == 1 ? value : extract(value, {k}));
    return result;
  }

  std::vector<Id> column(Id matrix, std::uint32_t c) {
    std::vector<Id> result;
    const FloatType columns = declarations_.type(typeOf_.at(matrix));
    for (std::uint32_t r = 0; r < declarations_.type(columns.component).count; ++r)
      result.push_back(extract(matrix, {c, r}));
    return result;
  }

  std::vector<Id> row(Id matrix, std::uint32_t r) {
    std::vector<Id> result;
    for (std::uint32_t c = 0; c < declarations_.type(typeOf_.at(matrix)).count; ++c)
      result.push_back(extract(matrix, {c, r}));
    return result;
  }

  Id extract(Id composite, const ModuleWords& indices) {
    const Id result = module_.newId();
    ModuleWords operands{composite};
    operands.insert(operands.end(), indices.begin(), indices.end());
    Instruction i = makeInstruction(SpvOpCompositeExtract, floatType(), result, operands);
    i.uses.resize(1);
    keep(std::move(i));
    return result;
  }

  /// Appends an operation on ids; returns its result, a new one if `result` is 0.
  Id add(SpvOp operation, Id type, const ModuleWords& operands, Id result = 0) {
    if (result == 0) result = module_.newId();
    keep(makeInstruction(operation, type, result, operands));
    return result;
  }

  Id call(std::uint32_t function, Id type, const ModuleWords& operands, Id result = 0) {
    if (result == 0) result = module_.newId();
    ModuleWords all{declarations_.library(), function};
    all.insert(all.end(), operands.begin(), operands.end());
    Instruction i = makeInstruction(SpvOpExtInst, type, result, all);
    i.uses.erase(i.uses.begin() + 1);
    keep(std::move(i));
    return result;
  }

  void keep(Instruction i) {
    switch (i.operation) {
      case SpvOpFNegate:
      case SpvOpFAdd:
      case SpvOpFSub:
      case SpvOpFMul:
      case SpvOpFDiv:
      case SpvOpVectorTimesScalar:
        decorations_.push_back(makeInstruction(SpvOpDecorate, 0, 0, {i.result, SpvDecorationNoContraction}));
        break;
      default:
        break;
    }
    if (i.type != 0 && i.result != 0) typeOf_[i.result] = i.type;
    to_->push_back(std::move(i));
  }

  ModuleBlocks& module_;
  Declarations declarations_;
  std::vector<Instruction>* to_ = nullptr;
  std::vector<Instruction> decorations_;
  std::map<Id, Id> typeOf_;  // of values
};

}  // namespace

void makePortable(ModuleBlocks& module) { Rewriter(module).run(); }

}  // namespace importon::gpu
