#include "scene/materials/webgl_technique.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>

#include "scene/container/gltf_json.h"

namespace importon {
namespace {

using Json = nlohmann::json;

constexpr const char* kTechnique = "KHR_techniques_webgl";

bool isCalledDiffuse(std::string name) {
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name.find("diffuse") != std::string::npos;
}

bool isColor(const Json& value) {
  return value.is_array() && (value.size() == 3 || value.size() == 4) &&
         std::ranges::all_of(value, [](const Json& component) { return component.is_number(); });
}

bool isTexture(const Json& value, std::size_t textures) {
  const Json& index = member(value, "index");
  return index.is_number_unsigned() && index.get<std::uint64_t>() < textures;
}

Json matte(const Json& values, std::size_t textures) {
  Json base{{"metallicFactor", 0}, {"roughnessFactor", 1}};
  if (!values.is_object()) return base;
  for (const auto& [name, value] : values.items()) {
    if (!isCalledDiffuse(name)) continue;
    if (isTexture(value, textures)) {
      base["baseColorTexture"] = {{"index", value["index"]},
                                  {"texCoord", std::max(integerOr(value, "texCoord", 0), 0)}};
    } else if (isColor(value)) {
      base["baseColorFactor"] = {1, 1, 1, 1};
      for (std::size_t c = 0; c < value.size(); ++c)
        base["baseColorFactor"][c] = std::clamp(value[c].get<double>(), 0.0, 1.0);
    }
  }
  return base;
}

}  // namespace

void convertTechniques(Json& document, const Faults& faults) {
  if (!document.contains("materials")) return;
  const std::size_t textures = member(document, "textures").size();
  Json& materials = document["materials"];
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const Json& technique = member(materials[i], "extensions", kTechnique);
    if (!technique.is_object() || materials[i].contains("pbrMetallicRoughness")) continue;
    faults.forgive("material by a program", fmt::format("/materials/{}/extensions/{}", i, kTechnique),
                   "the material is a program of WebGL", "it is matte, of the colour that its values call diffuse");
    materials[i]["pbrMetallicRoughness"] = matte(member(technique, "values"), textures);
  }
}

}  // namespace importon
