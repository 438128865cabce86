#include "scene/container/gltf_choices.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "base/error.h"
#include "scene/container/gltf_json.h"
#include "scene/container/gltf_source.h"

namespace importon {
namespace {

using Json = nlohmann::json;

constexpr const char* kVariants = "KHR_materials_variants";

const Json& variantsOf(const Json& document) { return member(document, "extensions", kVariants, "variants"); }

std::vector<std::string> namesOf(const Json& elements) {
  std::vector<std::string> names;
  for (const Json& element : elements) names.push_back(printable(stringOr(element, "name", "")));
  return names;
}

/// "0 first, 1 second".
std::string listOf(const Json& elements) {
  std::string list;
  const std::vector<std::string> names = namesOf(elements);
  for (std::size_t i = 0; i < names.size(); ++i) list += fmt::format("{}{} {}", i == 0 ? "" : ", ", i, names[i]);
  return list;
}

/// The element that is called `name`, else the one of that index.
std::optional<std::size_t> find(const Json& elements, const std::string& name) {
  for (std::size_t i = 0; i < elements.size(); ++i)
    if (stringOr(elements[i], "name", "") == name) return i;
  std::size_t index = 0;
  const char* end = name.data() + name.size();
  const auto parsed = std::from_chars(name.data(), end, index);
  const bool isIndex = parsed.ec == std::errc() && parsed.ptr == end && index < elements.size();
  return isIndex ? std::optional(index) : std::nullopt;
}

std::size_t choose(const Json& elements, const std::string& name, const char* kind, const char* option) {
  if (const std::optional<std::size_t> found = find(elements, name)) return *found;
  throw UsageError(
      fmt::format("no {} '{}'", kind, printable(name)), option,
      elements.empty() ? fmt::format("leave it out: the file has no {}", kind) : "use one of: " + listOf(elements));
}

/// The material that a primitive has in a variant; null: its own.
const Json& materialIn(const Json& primitive, std::size_t variant) {
  for (const Json& mapping : member(primitive, "extensions", kVariants, "mappings"))
    for (const Json& index : member(mapping, "variants"))
      if (index == variant) return member(mapping, "material");
  return member(Json(), "");
}

}  // namespace

void applyChoices(Json& document, const FileChoices& choices) {
  if (!choices.scene.empty()) document["scene"] = choose(member(document, "scenes"), choices.scene, "scene", "--scene");
  if (choices.variant.empty()) return;
  const std::size_t variant = choose(variantsOf(document), choices.variant, "variant", "--variant");
  if (!document.contains("meshes")) return;
  for (Json& mesh : document["meshes"]) {
    for (Json& primitive : mesh["primitives"]) {
      const Json material = materialIn(primitive, variant);
      if (!material.is_null()) primitive["material"] = material;
    }
  }
}

std::optional<std::size_t> chooseAnimation(const Json& document, const std::string& name) {
  if (name.empty()) return std::nullopt;
  return choose(member(document, "animations"), name, "animation", "--animation");
}

std::vector<std::string> sceneNames(const Json& document) { return namesOf(member(document, "scenes")); }

std::vector<std::string> variantNames(const Json& document) { return namesOf(variantsOf(document)); }

}  // namespace importon
