#include "gpu/spirv_reflection.h"

#include <algorithm>
#include <glslang/SPIRV/spirv.hpp>
#include <map>
#include <stdexcept>

namespace importon::gpu {
namespace {

/// An id's defining instruction, its operands after the result, and its decorations.
struct Id {
  spv::Op op = spv::OpNop;
  std::uint32_t type = 0;  // result type of constants and variables
  std::vector<std::uint32_t> operands;
  std::string name;
  std::map<std::uint32_t, std::string> memberNames;
  std::map<spv::Decoration, std::uint32_t> decorations;  // first literal, or 0
  std::map<std::uint32_t, std::uint32_t> memberOffsets;
  std::map<std::uint32_t, std::uint32_t> memberMatrixStrides;
  bool isUsed = false;  // read or written in a function
};

std::string readString(std::span<const std::uint32_t> words) {
  std::string text;
  for (const std::uint32_t word : words) {
    for (int shift = 0; shift < 32; shift += 8) {
      const char c = static_cast<char>((word >> shift) & 0xFFu);
      if (c == '\0') return text;
      text += c;
    }
  }
  return text;
}

class Module {
 public:
  explicit Module(std::span<const std::uint32_t> words) {
    if (words.size() < 5 || words[0] != spv::MagicNumber) throw std::logic_error("not a SPIR-V module");
    ids_.resize(words[3]);
    for (std::size_t at = 5; at < words.size();) {
      const std::size_t length = words[at] >> spv::WordCountShift;
      if (length == 0 || at + length > words.size()) throw std::logic_error("broken SPIR-V module");
      read(static_cast<spv::Op>(words[at] & spv::OpCodeMask), words.subspan(at + 1, length - 1));
      at += length;
    }
  }

  [[nodiscard]] Reflection reflection() {
    Reflection result;
    for (const Id& id : ids_) {
      if (id.op == spv::OpVariable) addVariable(result, id);
    }
    std::sort(result.bindings.begin(), result.bindings.end(),
              [](const ReflectedBinding& a, const ReflectedBinding& b) { return a.slot < b.slot; });
    addWorkgroupSize(result);
    return result;
  }

 private:
  using Words = std::span<const std::uint32_t>;

  Id& at(std::uint32_t id) {
    if (id >= ids_.size()) throw std::logic_error("broken SPIR-V module: id out of bounds");
    return ids_[id];
  }

  void read(spv::Op op, Words w) {
    readAnnotation(op, w);
    readDefinition(op, w);
    readUse(op, w);
  }

  void readAnnotation(spv::Op op, Words w) {
    switch (op) {
      case spv::OpName:
        at(w[0]).name = readString(w.subspan(1));
        break;
      case spv::OpMemberName:
        at(w[0]).memberNames[w[1]] = readString(w.subspan(2));
        break;
      case spv::OpDecorate:
        at(w[0]).decorations[static_cast<spv::Decoration>(w[1])] = w.size() > 2 ? w[2] : 0;
        break;
      case spv::OpMemberDecorate:
        if (w[2] == spv::DecorationOffset) at(w[0]).memberOffsets[w[1]] = w[3];
        if (w[2] == spv::DecorationMatrixStride) at(w[0]).memberMatrixStrides[w[1]] = w[3];
        break;
      case spv::OpExecutionMode:
        if (w[1] == spv::ExecutionModeLocalSize) std::copy(w.begin() + 2, w.begin() + 5, localSize_.begin());
        break;
      default:
        break;
    }
  }

  void readDefinition(spv::Op op, Words w) {
    switch (op) {
      case spv::OpTypeInt:
      case spv::OpTypeFloat:
      case spv::OpTypeVector:
      case spv::OpTypeMatrix:
      case spv::OpTypeImage:
      case spv::OpTypeSampledImage:
      case spv::OpTypeArray:
      case spv::OpTypeRuntimeArray:
      case spv::OpTypeStruct:
      case spv::OpTypePointer:
        at(w[0]).op = op;
        at(w[0]).operands.assign(w.begin() + 1, w.end());
        break;
      case spv::OpConstant:
      case spv::OpSpecConstant:
      case spv::OpConstantComposite:
      case spv::OpSpecConstantComposite:
      case spv::OpVariable:
        at(w[1]).op = op;
        at(w[1]).type = w[0];
        at(w[1]).operands.assign(w.begin() + 2, w.end());
        break;
      default:
        break;
    }
  }

  void readUse(spv::Op op, Words w) {
    switch (op) {
      case spv::OpStore:
        at(w[0]).isUsed = true;
        break;
      case spv::OpLoad:
      case spv::OpAccessChain:
      case spv::OpInBoundsAccessChain:
      case spv::OpArrayLength:
        at(w[2]).isUsed = true;
        break;
      case spv::OpFunctionCall:
        for (const std::uint32_t argument : w.subspan(3)) at(argument).isUsed = true;
        break;
      default:
        break;
    }
  }

  [[nodiscard]] std::uint32_t sizeOf(std::uint32_t typeId, std::uint32_t matrixStride) {
    const Id& type = at(typeId);
    switch (type.op) {
      case spv::OpTypeInt:
      case spv::OpTypeFloat:
        return type.operands[0] / 8;
      case spv::OpTypeVector:
        return sizeOf(type.operands[0], 0) * type.operands[1];
      case spv::OpTypeMatrix:
        return matrixStride * type.operands[1];
      case spv::OpTypeArray:
        return at(type.operands[1]).operands[0] * arrayStride(type);
      case spv::OpTypeStruct:
        return structBytes(type);
      case spv::OpTypeRuntimeArray:
        return 0;
      default:
        throw std::logic_error("a block holds a type that our kernels must not use");
    }
  }

  [[nodiscard]] static std::uint32_t arrayStride(const Id& type) {
    return type.decorations.at(spv::DecorationArrayStride);
  }

  [[nodiscard]] std::uint32_t memberBytes(const Id& type, std::uint32_t member) {
    const auto stride = type.memberMatrixStrides.find(member);
    return sizeOf(type.operands[member], stride == type.memberMatrixStrides.end() ? 0 : stride->second);
  }

  [[nodiscard]] std::uint32_t structBytes(const Id& type) {
    std::uint32_t bytes = 0;
    for (std::uint32_t i = 0; i < type.operands.size(); ++i) {
      bytes = std::max(bytes, type.memberOffsets.at(i) + memberBytes(type, i));
    }
    return bytes;
  }

  void addVariable(Reflection& result, const Id& variable) {
    const auto storage = static_cast<spv::StorageClass>(variable.operands[0]);
    const std::uint32_t typeId = at(variable.type).operands[1];
    const Id& type = at(typeId);
    if (storage == spv::StorageClassPushConstant) {
      result.pushConstantBytes = structBytes(type);
      addStructs(result, typeId, 0, true);
      return;
    }
    if (storage != spv::StorageClassStorageBuffer && storage != spv::StorageClassUniform &&
        storage != spv::StorageClassUniformConstant) {
      return;
    }
    const std::string name = variable.name.empty() ? type.name : variable.name;
    const auto set = variable.decorations.find(spv::DecorationDescriptorSet);
    if (set != variable.decorations.end() && set->second != 0) throw std::logic_error(name + " is not in set 0");
    const BindingKind kind = kindOf(storage, type, name);
    if (variable.isUsed) result.bindings.push_back({variable.decorations.at(spv::DecorationBinding), kind, name});
    if (storage != spv::StorageClassUniformConstant) addStructs(result, typeId, 0, true);
  }

  [[nodiscard]] BindingKind kindOf(spv::StorageClass storage, const Id& type, const std::string& name) {
    if (storage == spv::StorageClassUniformConstant) {
      const bool isTexelBuffer = type.op == spv::OpTypeSampledImage &&
                                 at(type.operands[0]).operands[1] == static_cast<std::uint32_t>(spv::DimBuffer);
      if (!isTexelBuffer) throw std::logic_error(name + " is neither a buffer nor a uniform texel buffer");
      return BindingKind::uniformTexelBuffer;
    }
    if (type.op != spv::OpTypeStruct) throw std::logic_error(name + " is an array of descriptors");
    return storage == spv::StorageClassStorageBuffer ? BindingKind::storageBuffer : BindingKind::uniformBuffer;
  }

  /// Adds the struct `typeId`, and those within it, unless they are there.
  void addStructs(Reflection& result, std::uint32_t typeId, std::uint32_t stride, bool isBlock) {
    const Id& type = at(typeId);
    if (type.op == spv::OpTypeArray || type.op == spv::OpTypeRuntimeArray) {
      addStructs(result, type.operands[0], arrayStride(type), false);
      return;
    }
    if (type.op != spv::OpTypeStruct) return;
    if (const auto known = seen_.find(typeId); known != seen_.end()) {
      std::uint32_t& knownStride = result.structs[known->second].arrayStride;
      if (knownStride == 0) knownStride = stride;
      return;
    }
    seen_[typeId] = result.structs.size();
    ReflectedStruct reflected{type.name, {}, structBytes(type), stride, false};
    reflected.isWrapper = isBlock && type.operands.size() == 1 && type.memberOffsets.at(0) == 0;
    for (std::uint32_t i = 0; i < type.operands.size(); ++i) {
      const auto name = type.memberNames.find(i);
      reflected.members.push_back(
          {name == type.memberNames.end() ? "" : name->second, type.memberOffsets.at(i), memberBytes(type, i)});
    }
    result.structs.push_back(std::move(reflected));
    for (const std::uint32_t member : type.operands) addStructs(result, member, 0, false);
  }

  void addWorkgroupSize(Reflection& result) {
    result.workgroupSize = localSize_;
    for (const Id& id : ids_) {
      const auto builtIn = id.decorations.find(spv::DecorationBuiltIn);
      if (builtIn == id.decorations.end() || builtIn->second != static_cast<std::uint32_t>(spv::BuiltInWorkgroupSize))
        continue;
      for (std::size_t i = 0; i < 3; ++i) {
        const Id& size = at(id.operands[i]);
        result.workgroupSize[i] = size.operands[0];
        const auto constant = size.decorations.find(spv::DecorationSpecId);
        if (i == 0 && constant != size.decorations.end()) result.workgroupSizeXConstant = constant->second;
      }
    }
  }

  std::vector<Id> ids_;
  std::array<std::uint32_t, 3> localSize_{1, 1, 1};
  std::map<std::uint32_t, std::size_t> seen_;  // type id -> index into Reflection::structs
};

}  // namespace

Reflection reflect(std::span<const std::uint32_t> spirv) { return Module(spirv).reflection(); }

}  // namespace importon::gpu
