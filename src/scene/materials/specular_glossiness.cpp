#include "scene/materials/specular_glossiness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/error.h"
#include "scene/container/gltf_json.h"
#include "scene/images/texture_sampling.h"
#include "scene/scene.h"

namespace importon {
namespace {

using Json = nlohmann::json;

constexpr const char* kGlossiness = "KHR_materials_pbrSpecularGlossiness";
constexpr float kReflectance = 0.04f;  // of ior 1.5 at normal incidence

void copyTexture(const Json& from, const char* key, Json& to, const char* newKey) {
  if (from.contains(key)) to[newKey] = from[key];
}

void convert(Json& material) {
  const Json own = material["extensions"][kGlossiness];
  const bool hasTexture = own.contains("specularGlossinessTexture");
  const vec4 diffuse = vectorOr<4>(own, "diffuseFactor", vec4(1.0f));
  const vec3 specular = vectorOr<3>(own, "specularFactor", vec3(1.0f)) / kReflectance;
  Json base{{"baseColorFactor", {diffuse.r, diffuse.g, diffuse.b, diffuse.a}},
            {"metallicFactor", 0},
            {"roughnessFactor", hasTexture ? 1.0 : 1.0 - numberOr(own, "glossinessFactor", 1.0)}};
  copyTexture(own, "diffuseTexture", base, "baseColorTexture");
  copyTexture(own, "specularGlossinessTexture", base, "metallicRoughnessTexture");
  Json reflection{{"specularColorFactor", {specular.r, specular.g, specular.b}}};
  copyTexture(own, "specularGlossinessTexture", reflection, "specularColorTexture");
  material["pbrMetallicRoughness"] = std::move(base);
  material["extensions"]["KHR_materials_specular"] = std::move(reflection);
  material["extensions"].erase("KHR_materials_ior");
}

/// 1 - factor · alpha in green, of 8 bits.
uint roughnessTexel(float alpha, float factor) {
  return static_cast<uint>(std::lround((1.0f - factor * alpha) * 255.0f)) << 8;
}

}  // namespace

void convertSpecularGlossiness(Json& document) {
  if (!document.contains("materials")) return;
  for (Json& material : document["materials"])
    if (member(material, "extensions", kGlossiness).is_object()) convert(material);
}

std::optional<float> glossinessFactorOf(const Json& material) {
  const Json& own = member(material, "extensions", kGlossiness);
  if (!member(own, "specularGlossinessTexture").is_object()) return std::nullopt;
  return floatOr(own, "glossinessFactor", 1.0f);
}

void makeRoughnessTextures(MaterialSet& set, std::vector<uint>& texels, const std::string& name) {
  std::map<std::pair<uint, float>, uint> made;
  for (const GlossyMaterial& use : set.glossiness) {
    uint& index = set.materials[use.material].metallicRoughnessTexture;
    if (index == kNone) continue;
    const auto [entry, isNew] = made.try_emplace({index, use.factor}, static_cast<uint>(set.textures.size()));
    if (isNew) {
      Texture texture = set.textures[index];
      const std::size_t count = std::size_t{texture.width} * texture.height, first = texels.size();
      if (count > kMostTexels - std::min(first, kMostTexels)) {
        throw SceneError(fmt::format("the images have more than {} texels in all", kMostTexels), name,
                         "reduce the images");
      }
      texels.resize(first + count);
      for (std::size_t i = 0; i < count; ++i)
        texels[first + i] = roughnessTexel(texelAt(texture, texels, i).w, use.factor);
      texture.firstTexel = static_cast<uint>(first);
      texture.isDeep = 0;
      set.textures.push_back(texture);
    }
    index = entry->second;
  }
}

}  // namespace importon
