#include "scene/materials/gltf_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "scene/container/gltf_json.h"
#include "scene/images/gltf_texture.h"
#include "scene/materials/specular_glossiness.h"

namespace importon {
namespace {

using Json = nlohmann::json;

/// Reads one material; its textures go to `textures`.
class MaterialReader {
 public:
  MaterialReader(const Json& json, std::string pointer, TextureTable& textures)
      : json_(json), pointer_(std::move(pointer)), textures_(textures) {}

  Material read(const Faults& faults) {
    material_ = defaultMaterial();
    for (const MaterialRow& row : materialRows()) readFactor(row);
    readEmission();
    readTransmission(faults);
    readFlags();
    for (const MaterialRow& row : materialRows()) readTexture(row);
    return material_;
  }

 private:
  const Json& extension(std::string_view name) const { return member(json_, "extensions", name); }

  /// The object that has the row's value; null if there is none.
  const Json& ownerOf(const MaterialRow& row) const {
    const Json* owner = &json_;
    for (std::string_view left = row.place; !left.empty();) {
      const std::size_t end = std::min(left.find('/'), left.size());
      owner = &member(*owner, left.substr(0, end));
      left.remove_prefix(std::min(end + 1, left.size()));
    }
    return *owner;
  }

  void readFactor(const MaterialRow& row) {
    const Json& owner = ownerOf(row);
    if (const auto* number = std::get_if<float Material::*>(&row.field))
      material_.*(*number) = floatOr(owner, row.key, row.otherwise);
    else if (const auto* color = std::get_if<vec3 Material::*>(&row.field))
      material_.*(*color) = vectorOr<3>(owner, row.key, vec3(row.otherwise));
    else if (const auto* withAlpha = std::get_if<vec4 Material::*>(&row.field))
      material_.*(*withAlpha) = vectorOr<4>(owner, row.key, vec4(row.otherwise));
  }

  void readTexture(const MaterialRow& row) {
    const auto* texture = std::get_if<MaterialTexture>(&row.field);
    if (texture == nullptr || (texture->isNeeded != nullptr && !texture->isNeeded(material_))) return;
    const std::string place = row.place.empty() ? "" : fmt::format("/{}", row.place);
    material_.*texture->index = textures_.use(member(ownerOf(row), row.key),
                                              fmt::format("{}{}/{}", pointer_, place, row.key), texture->meaning);
  }

  void readEmission() {
    material_.emission *= floatOr(extension("KHR_materials_emissive_strength"), "emissiveStrength", 1.0f);
    if (material_.emission != vec3(0.0f)) material_.flags |= kMaterialEmissive;
  }

  void readTransmission(const Faults& faults) {
    material_.ior = ior(faults);
    const Json& volume = extension("KHR_materials_volume");
    if (material_.thickness <= 0.0f) return;
    material_.flags |= kMaterialSolid;
    material_.absorption =
        absorption(vectorOr<3>(volume, "attenuationColor", vec3(1.0f)), numberOr(volume, "attenuationDistance", 0.0));
  }

  /// KHR_materials_ior: at least 1, or 0 for a surface that reflects all light, here a very dense one.
  float ior(const Faults& faults) const {
    constexpr float kReflectsAll = 1e4f;
    const float value = floatOr(extension("KHR_materials_ior"), "ior", 1.5f);
    if (value == 0.0f) return kReflectsAll;
    if (value >= 1.0f) return std::min(value, kReflectsAll);
    faults.forgive("number off its range", pointer_ + "/extensions/KHR_materials_ior/ior",
                   fmt::format("ior {} is less than 1", value), "1 is taken");
    return 1.0f;
  }

  /// -ln(attenuationColor) / attenuationDistance per m; no distance: infinite. A black channel gets the
  /// absorption of the least float that isn't 0.
  static vec3 absorption(const vec3& color, double distance) {
    vec3 result(0.0f);
    if (!(distance > 0)) return result;
    for (int c = 0; c < 3; ++c) {
      const double least = std::numeric_limits<float>::min();
      result[c] = toFloat(-std::log(std::max(static_cast<double>(color[c]), least)) / distance);
    }
    return result;
  }

  void readFlags() {
    const std::string mode = stringOr(json_, "alphaMode", "OPAQUE");
    if (mode == "MASK") material_.flags |= kMaterialAlphaMask;
    if (mode == "BLEND") material_.flags |= kMaterialAlphaBlend;
    if (booleanOr(json_, "doubleSided", false)) material_.flags |= kMaterialDoubleSided;
    if (extension("KHR_materials_unlit").is_object()) material_.flags |= kMaterialUnlit;
  }

  const Json& json_;
  std::string pointer_;
  TextureTable& textures_;
  Material material_{};
};

}  // namespace

Material defaultMaterial() {
  Material material{};
  material.ior = 1.5f;
  for (const MaterialRow& row : materialRows()) {
    if (const auto* number = std::get_if<float Material::*>(&row.field)) material.*(*number) = row.otherwise;
    if (const auto* color = std::get_if<vec3 Material::*>(&row.field)) material.*(*color) = vec3(row.otherwise);
    if (const auto* withAlpha = std::get_if<vec4 Material::*>(&row.field)) material.*(*withAlpha) = vec4(row.otherwise);
    if (const auto* texture = std::get_if<MaterialTexture>(&row.field)) material.*texture->index = kNone;
  }
  return material;
}

unsigned uvSetsOf(const Material& material, const std::vector<Texture>& textures) {
  unsigned sets = 0;
  visitTextures(material, [&](uint texture) {
    if (texture != kNone) sets |= 1u << textures[texture].uvSet;
  });
  return sets;
}

bool boundsVolume(const GltfDocument& document, int material) {
  if (material < 0) return false;
  const Json& extensions =
      member(element(member(document.json, "materials"), static_cast<std::size_t>(material)), "extensions");
  const auto isAbove0 = [&](const char* extension, const char* key) {
    return floatOr(member(extensions, extension), key, 0.0f) > 0;
  };
  return isAbove0("KHR_materials_volume", "thicknessFactor") &&
         (isAbove0("KHR_materials_transmission", "transmissionFactor") ||
          isAbove0("KHR_materials_diffuse_transmission", "diffuseTransmissionFactor"));
}

MaterialSet readMaterials(const GltfDocument& document, const std::vector<bool>& isUsed, Log& log) {
  MaterialSet set;
  set.materialOfFile.assign(isUsed.size(), kNone);
  TextureTable textures(document, log);
  const Json& materials = member(document.json, "materials");
  for (std::size_t i = 0; i < isUsed.size(); ++i) {
    if (!isUsed[i]) continue;
    set.materialOfFile[i] = static_cast<uint>(set.materials.size());
    if (const std::optional<float> factor = glossinessFactorOf(element(materials, i)))
      set.glossiness.push_back({set.materials.size(), *factor});
    MaterialReader reader(element(materials, i), fmt::format("/materials/{}", i), textures);
    set.materials.push_back(reader.read(document.faults));
    set.names.push_back(stringOr(element(materials, i), "name", ""));
  }
  set.textures = textures.textures();
  set.imageOfTexture = textures.images();
  return set;
}

}  // namespace importon
