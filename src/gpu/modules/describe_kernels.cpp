/// Writes the calls of compute shaders in C++, from what their SPIR-V modules say about themselves:
///   importon_describe_kernels FOLDER NAMESPACE SYMBOLS SHARED MODULE...
/// FOLDER/include/NAMESPACE/ receives NAME.h for each NAME.spv, buffers.h and registry.h; FOLDER/registry.cpp defines
/// what they declare. NAME.lean and NAME.placed lie beside NAME.spv (optimise_module.cpp). SYMBOLS_NAME,
/// SYMBOLS_NAME_end, SYMBOLS_NAME_lean_end and SYMBOLS_NAME_placed_end stand about the words of the three. Structs that
/// a header of the folder SHARED declares are held to lie on the device as in C++. Files that would not change are left
/// as they are.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spirv_cross/spirv_cross_c.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Member {
  std::string type, name;
  unsigned offset;  // bytes
  bool operator==(const Member&) const = default;
};

struct Struct {
  std::vector<Member> members;
  std::size_t stride = 0;    // bytes between its items in an array; 0: there is no array of it
  bool isAmbiguous = false;  // kernels lay it out in different ways, as they may where it is none of the host's
};

struct Binding {
  unsigned slot;
  std::string kind, name;
  unsigned texelWords;  // 32-bit words of a texel; 0: none
};

struct Module {
  std::string name;
  std::vector<Binding> buffers;  // by slot
  Struct push;
  std::size_t pushBytes = 0;
  unsigned workgroupSize = 1;
  bool hasWorkgroupConstant = false;
  std::set<unsigned> constants;  // ids of its specialization constants
  std::vector<unsigned> rare;    // those of them that its lean module has not
};

/// film_add -> FilmAdd, photonFlux -> PhotonFlux.
std::string typeName(const std::string& name) {
  std::string type;
  bool isFirst = true;
  for (const char c : name) {
    if (c != '_') type += isFirst ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    isFirst = c == '_';
  }
  return type;
}

std::string withoutEnd(std::string text, const std::string& end) {
  if (text.size() > end.size() && text.ends_with(end)) text.resize(text.size() - end.size());
  return text;
}

/// What the names of texel buffers end in, and the words of one texel: SPIR-V does not tell a texel's size.
constexpr std::pair<std::string_view, unsigned> kTexelEnds[] = {{"Words", 1}, {"Pairs", 2}, {"Texels", 4}};

unsigned texelWordsOf(const std::string& declared) {
  for (const auto& [end, words] : kTexelEnds)
    if (declared.ends_with(end)) return words;
  throw std::runtime_error(fmt::format("texel buffer {}: its name must end in Words, Pairs or Texels", declared));
}

/// Block QueueBlock, words queueWords and texels queueTexels are all the buffer queue.
std::string bufferName(const std::string& declared) {
  std::string name = withoutEnd(declared, "Block");
  for (const auto& [end, words] : kTexelEnds) name = withoutEnd(name, std::string(end));
  name.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(name.front())));
  return name;
}

class Reflection {
 public:
  Reflection(const fs::path& file, std::map<std::string, Struct>& structs) : structs_(structs) {
    std::ifstream stream(file, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
    std::vector<SpvId> words(bytes.size() / sizeof(SpvId));
    std::copy_n(bytes.begin(), words.size() * sizeof(SpvId), reinterpret_cast<char*>(words.data()));
    check(spvc_context_create(&context_));
    spvc_parsed_ir ir = nullptr;
    check(spvc_context_parse_spirv(context_, words.data(), words.size(), &ir));
    check(spvc_context_create_compiler(context_, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP, &compiler_));
    spvc_set active = nullptr;
    check(spvc_compiler_get_active_interface_variables(compiler_, &active));
    check(spvc_compiler_create_shader_resources_for_active_variables(compiler_, &resources_, active));
  }
  ~Reflection() { spvc_context_destroy(context_); }
  Reflection(const Reflection&) = delete;
  Reflection& operator=(const Reflection&) = delete;

  Module describe(const std::string& name) {
    Module module;
    module.name = name;
    addBuffers(module, SPVC_RESOURCE_TYPE_STORAGE_BUFFER, "storage");
    addBuffers(module, SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, "uniform");
    addBuffers(module, SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, "texels");
    std::sort(module.buffers.begin(), module.buffers.end(),
              [](const Binding& a, const Binding& b) { return a.slot < b.slot; });
    for (const spvc_reflected_resource& push : list(SPVC_RESOURCE_TYPE_PUSH_CONSTANT)) {
      module.push = readStruct(push.base_type_id);
      check(spvc_compiler_get_declared_struct_size(compiler_, handle(push.base_type_id), &module.pushBytes));
    }
    const spvc_specialization_constant* constants = nullptr;
    std::size_t count = 0;
    check(spvc_compiler_get_specialization_constants(compiler_, &constants, &count));
    for (std::size_t i = 0; i < count; ++i) module.constants.insert(constants[i].constant_id);
    spvc_specialization_constant x{}, y{}, z{};
    spvc_compiler_get_work_group_size_specialization_constants(compiler_, &x, &y, &z);
    module.hasWorkgroupConstant = x.id != 0;
    if (x.id != 0)
      module.workgroupSize = spvc_constant_get_scalar_u32(spvc_compiler_get_constant_handle(compiler_, x.id), 0, 0);
    else
      module.workgroupSize =
          spvc_compiler_get_execution_mode_argument_by_index(compiler_, SpvExecutionModeLocalSize, 0);
    return module;
  }

 private:
  void check(spvc_result result) const {
    if (result != SPVC_SUCCESS) throw std::runtime_error(spvc_context_get_last_error_string(context_));
  }
  spvc_type handle(spvc_type_id id) const { return spvc_compiler_get_type_handle(compiler_, id); }

  std::vector<spvc_reflected_resource> list(spvc_resource_type type) const {
    const spvc_reflected_resource* found = nullptr;
    std::size_t count = 0;
    check(spvc_resources_get_resource_list_for_type(resources_, type, &found, &count));
    return {found, found + count};
  }

  void addBuffers(Module& module, spvc_resource_type type, const std::string& kind) {
    for (const spvc_reflected_resource& r : list(type)) {
      module.buffers.push_back({spvc_compiler_get_decoration(compiler_, r.id, SpvDecorationBinding), kind,
                                bufferName(r.name), kind == "texels" ? texelWordsOf(r.name) : 0});
      if (kind == "storage") readStruct(r.base_type_id);
    }
  }

  /// As C++ calls a type that a buffer or push constants hold.
  std::string typeOf(spvc_type_id id) {
    const spvc_type type = handle(id);
    const unsigned size = spvc_type_get_vector_size(type);
    const auto vector = [size](const char* scalar, const char* prefix) {
      return size == 1 ? std::string(scalar) : fmt::format("{}vec{}", prefix, size);
    };
    switch (spvc_type_get_basetype(type)) {
      case SPVC_BASETYPE_UINT32:
        return vector("uint", "u");
      case SPVC_BASETYPE_INT32:
        return vector("int", "i");
      case SPVC_BASETYPE_FP32:
        return vector("float", "");
      case SPVC_BASETYPE_STRUCT:
        return spvc_compiler_get_name(compiler_, spvc_type_get_base_type_id(type));
      default:
        return "";
    }
  }

  /// Notes the structs within it, too.
  Struct readStruct(spvc_type_id id) {
    Struct result;
    const spvc_type type = handle(id);
    for (unsigned i = 0; i < spvc_type_get_num_member_types(type); ++i) {
      const spvc_type_id memberId = spvc_type_get_member_type(type, i);
      unsigned offset = 0;
      check(spvc_compiler_type_struct_member_offset(compiler_, type, i, &offset));
      result.members.push_back({typeOf(memberId), spvc_compiler_get_member_name(compiler_, id, i), offset});
      if (spvc_type_get_basetype(handle(memberId)) != SPVC_BASETYPE_STRUCT) continue;
      Struct inner = readStruct(spvc_type_get_base_type_id(handle(memberId)));
      unsigned stride = 0;
      if (spvc_type_get_num_array_dimensions(handle(memberId)) > 0)
        check(spvc_compiler_type_struct_member_array_stride(compiler_, type, i, &stride));
      Struct& known = structs_[result.members.back().type];
      inner.isAmbiguous = known.isAmbiguous || (!known.members.empty() && known.members != inner.members);
      inner.stride = std::max<std::size_t>(known.stride, stride);
      known = inner;
    }
    return result;
  }

  std::map<std::string, Struct>& structs_;
  spvc_context context_ = nullptr;
  spvc_compiler compiler_ = nullptr;
  spvc_resources resources_ = nullptr;
};

void writeFile(const fs::path& file, const std::string& text) {
  std::ifstream old(file, std::ios::binary);
  if (old && std::string{std::istreambuf_iterator<char>(old), {}} == text) return;
  fs::create_directories(file.parent_path());
  std::ofstream stream(file, std::ios::binary);
  if (!(stream << text).flush()) throw std::runtime_error("cannot write " + file.string());
}

/// Where `owners...` have each buffer: as a public member of that name, in the first of them that has one.
std::string describeNames(const std::string& space, const std::set<std::string>& names) {
  std::string text = fmt::format(
      "/// The buffers of kernels by their names: an owner of each one alone, and the search for it among owners.\n"
      "#pragma once\n#include \"gpu/buffer.h\"\n\nnamespace importon::{}::buffers {{\n\n",
      space);
  for (const std::string& name : names)
    text += fmt::format("struct {} {{\n  const gpu::Buffer& {};\n}};\n", typeName(name), name);
  text += fmt::format("\n}}  // namespace importon::{0}::buffers\n\nnamespace importon::{0}::find {{\n", space);
  for (const std::string& name : names)
    text += fmt::format(R"(
template <class First, class... Rest>
const gpu::Buffer& {0}(const First& first, const Rest&... rest) {{
  if constexpr (requires {{ first.{0}; }}) {{
    return first.{0};
  }} else {{
    static_assert(sizeof...(rest) > 0, "none of the owners has a buffer '{0}'");
    return {0}(rest...);
  }}
}}
)",
                        name);
  return text + fmt::format("\n}}  // namespace importon::{}::find\n", space);
}

std::string describeCall(const std::string& space, const Module& module) {
  const std::string type = typeName(module.name);
  std::string members, checks, found, label = module.name;
  std::replace(label.begin(), label.end(), '_', ' ');
  for (const Member& member : module.push.members) {
    members += fmt::format("    {} {};\n", member.type, member.name);
    checks += fmt::format("static_assert(offsetof({}::Push, {}) == {});\n", type, member.name, member.offset);
  }
  if (module.pushBytes > 0) checks += fmt::format("static_assert(sizeof({}::Push) == {});\n", type, module.pushBytes);
  for (const Binding& buffer : module.buffers)
    found += fmt::format("{}&find::{}(owners...)", found.empty() ? "" : ",\n            ", buffer.name);
  const std::string push = members.empty() ? "  struct Push {};\n" : "  struct Push {\n" + members + "  };\n";
  return fmt::format(R"(/// How to call {name}.comp.
#pragma once
#include <array>
#include <cstddef>

#include "gpu/kernel_code.h"
#include "shared/render_data.h"
#include "{space}/buffers.h"

namespace importon::{space} {{

struct {type} {{
  static const gpu::KernelCode kCode;
  static constexpr std::string_view kLabel = "{label}";
{push}  /// By slot, each from the first of `owners` that has a member of its name.
  template <class... Owners>
  [[nodiscard]] static std::array<const gpu::Buffer*, {count}> buffers([[maybe_unused]] const Owners&... owners) {{
    return {{{found}}};
  }}
}};
{checks}
}}  // namespace importon::{space}
)",
                     fmt::arg("name", module.name), fmt::arg("space", space), fmt::arg("type", type),
                     fmt::arg("label", label), fmt::arg("push", push), fmt::arg("count", module.buffers.size()),
                     fmt::arg("found", found), fmt::arg("checks", checks));
}

std::string describeCode(const std::string& symbols, const Module& module) {
  std::string buffers;
  for (const Binding& b : module.buffers)
    buffers += fmt::format("    {{{}, gpu::BufferKind::{}, \"{}\", {}}},\n", b.slot, b.kind, b.name, b.texelWords);
  std::string text;
  const std::string type = typeName(module.name);
  if (!buffers.empty())
    text += fmt::format("static constexpr gpu::KernelBuffer kBuffersOf{}[] = {{\n{}}};\n", type, buffers);
  if (!module.rare.empty())
    text += fmt::format("static constexpr std::uint32_t kRareOf{}[] = {{{}}};\n", type, fmt::join(module.rare, ", "));
  return text + fmt::format(
                    "const gpu::KernelCode {0}::kCode{{\"{1}\", {2}_{1}, {2}_{1}_end, {2}_{1}_lean_end, "
                    "{2}_{1}_placed_end, {3}, {4}, {5}, "
                    "{6}, {7}}};\n",
                    type, module.name, symbols, module.rare.empty() ? "{}" : "kRareOf" + type,
                    buffers.empty() ? "{}" : "kBuffersOf" + type, module.pushBytes, module.workgroupSize,
                    module.hasWorkgroupConstant);
}

/// The layouts of the structs that headers of `shared` declare.
std::string describeLayouts(const fs::path& shared, const std::map<std::string, Struct>& structs) {
  std::string includes, checks, all;
  for (const fs::directory_entry& entry : fs::directory_iterator(shared)) {
    std::ifstream stream(entry.path());
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    bool isUsed = false;
    for (const auto& [name, layout] : structs) {
      if (!std::regex_search(text, std::regex("\\bstruct " + name + "\\b"))) continue;
      isUsed = true;
      if (layout.isAmbiguous)
        throw std::runtime_error(fmt::format("kernels lay out {} of {} in two ways", name, entry.path().string()));
      for (const Member& member : layout.members)
        checks += fmt::format("static_assert(offsetof({}, {}) == {});\n", name, member.name, member.offset);
      if (layout.stride > 0) checks += fmt::format("static_assert(sizeof({}) == {});\n", name, layout.stride);
    }
    if (isUsed) includes += fmt::format("#include \"shared/{}\"\n", entry.path().filename().string());
  }
  return includes + "\nnamespace importon {\n" + checks + "}  // namespace importon\n";
}

void run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 5) throw std::runtime_error("FOLDER NAMESPACE SYMBOLS SHARED MODULE... are wanted");
  const fs::path folder = arguments[0];
  const std::string &space = arguments[1], &symbols = arguments[2];
  std::map<std::string, Struct> structs;
  std::set<std::string> names;
  std::string includes, declarations, codes, list;
  for (std::size_t i = 4; i < arguments.size(); ++i) {
    const std::string name = fs::path(arguments[i]).stem().string();
    Module module = Reflection(arguments[i], structs).describe(name);
    const fs::path lean = fs::path(arguments[i]).replace_extension(".lean");
    if (fs::file_size(lean) > 0)
      std::ranges::set_difference(module.constants, Reflection(lean, structs).describe(name).constants,
                                  std::back_inserter(module.rare));
    for (const Binding& buffer : module.buffers) names.insert(buffer.name);
    writeFile(folder / "include" / space / (name + ".h"), describeCall(space, module));
    includes += fmt::format("#include \"{}/{}.h\"\n", space, name);
    declarations += fmt::format(
        "extern \"C\" const std::uint32_t {0}_{1}[], {0}_{1}_end[], {0}_{1}_lean_end[], {0}_{1}_placed_end[];\n",
        symbols, name);
    codes += describeCode(symbols, module);
    list += fmt::format("    &{}::kCode,\n", typeName(name));
  }
  writeFile(folder / "include" / space / "buffers.h", describeNames(space, names));
  writeFile(folder / "include" / space / "registry.h", fmt::format(R"(/// All kernels that are built in.
#pragma once
#include <span>

#include "gpu/kernel_code.h"

namespace importon::{0} {{

/// By name.
[[nodiscard]] std::span<const gpu::KernelCode* const> all();
/// That of `name`.comp. Throws std::logic_error for an unknown name.
[[nodiscard]] const gpu::KernelCode& code(std::string_view name);

}}  // namespace importon::{0}
)",
                                                                   space));
  writeFile(folder / "registry.cpp",
            fmt::format(R"(#include "{0}/registry.h"

#include <stdexcept>
#include <string>

{1}{2}
// Of the assembly beside this file.
{3}
namespace importon::{0} {{

{4}
namespace {{
const gpu::KernelCode* const kAll[] = {{
{5}}};
}}  // namespace

std::span<const gpu::KernelCode* const> all() {{ return kAll; }}

const gpu::KernelCode& code(std::string_view name) {{
  for (const gpu::KernelCode* each : kAll)
    if (each->name == name) return *each;
  throw std::logic_error("no kernel is named '" + std::string(name) + "'");
}}

}}  // namespace importon::{0}
)",
                        space, includes, describeLayouts(arguments[3], structs), declarations, codes, list));
}

}  // namespace

int main(int count, char** arguments) {
  try {
    run({arguments + 1, arguments + count});
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "importon_describe_kernels: " << error.what() << "\n";
    return 1;
  }
}
