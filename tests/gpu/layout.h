/// How the host lays out the structs it shares with the kernels, for comparison with the SPIR-V modules.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "gpu/spirv_reflection.h"

namespace importon::test {

struct HostMember {
  std::string name;
  std::size_t offset, bytes;
};

struct HostLayout {
  std::string name;
  std::size_t bytes;
  std::vector<HostMember> members;
};

/// All shared structs (layouts.cpp).
[[nodiscard]] std::vector<HostLayout> hostLayouts();

/// What is different between a struct of a module and the host's; empty: nothing.
[[nodiscard]] std::string difference(const gpu::ReflectedStruct& device, std::span<const HostLayout> host);

/// Names from the text "a, b, c", offsets and sizes from the members themselves.
template <class Struct, class... Members>
HostLayout makeLayout(const char* name, const std::string& memberNames, const Struct& object,
                      const Members&... members) {
  HostLayout layout{name, sizeof(Struct), {}};
  const auto* const start = reinterpret_cast<const std::byte*>(&object);
  (layout.members.push_back(
       {"", static_cast<std::size_t>(reinterpret_cast<const std::byte*>(&members) - start), sizeof(Members)}),
   ...);
  std::size_t begin = 0;
  for (HostMember& member : layout.members) {
    const std::size_t end = std::min(memberNames.find(',', begin), memberNames.size());
    member.name = memberNames.substr(begin, end - begin);
    begin = std::min(memberNames.find_first_not_of(", ", end), memberNames.size());
  }
  return layout;
}

}  // namespace importon::test

/// The layout of a shared struct. Takes all members in order: a missing one does not compile.
#define IMPORTON_LAYOUT(Struct, ...)                                                       \
  [] {                                                                                     \
    const Struct layoutObject{};                                                           \
    const auto& [__VA_ARGS__] = layoutObject;                                              \
    return ::importon::test::makeLayout(#Struct, #__VA_ARGS__, layoutObject, __VA_ARGS__); \
  }()
