#include "scene/gltf_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "scene/gltf_json.h"
#include "scene/gltf_texture.h"

namespace importon {
namespace {

using Json = nlohmann::json;

/// Reads one material; its textures go to `textures`.
class MaterialReader {
 public:
  MaterialReader(const Json& json, std::string pointer, TextureTable& textures)
      : json_(json), pointer_(std::move(pointer)), textures_(textures) {}

  Material read(const GltfSource& source) {
    material_ = defaultMaterial();
    readBase();
    readSurface();
    readEmission();
    readTransmission(source);
    readLayers();
    readAlpha();
    if (booleanOr(json_, "doubleSided", false)) material_.flags |= kMaterialDoubleSided;
    if (extension("KHR_materials_unlit").is_object()) material_.flags |= kMaterialUnlit;
    return material_;
  }

 private:
  const Json& extension(std::string_view name) const { return member(json_, "extensions", name); }

  /// The texture `key` of `owner`, which stands at `place` below the material.
  uint texture(const Json& owner, const std::string& place, const char* key, ColorMeaning meaning) {
    return textures_.use(member(owner, key), pointer_ + place + "/" + key, meaning);
  }

  void readBase() {
    const Json& pbr = member(json_, "pbrMetallicRoughness");
    const std::string place = "/pbrMetallicRoughness";
    material_.baseColor = vectorOr<4>(pbr, "baseColorFactor", material_.baseColor);
    material_.metallic = floatOr(pbr, "metallicFactor", material_.metallic);
    material_.roughness = floatOr(pbr, "roughnessFactor", material_.roughness);
    material_.baseColorTexture = texture(pbr, place, "baseColorTexture", ColorMeaning::srgb);
    material_.metallicRoughnessTexture = texture(pbr, place, "metallicRoughnessTexture", ColorMeaning::linear);
  }

  void readSurface() {
    material_.normalTexture = texture(json_, "", "normalTexture", ColorMeaning::linear);
    material_.normalScale = floatOr(member(json_, "normalTexture"), "scale", 1.0f);
    const std::string place = "/extensions/KHR_materials_specular";
    const Json& specular = extension("KHR_materials_specular");
    material_.specular = floatOr(specular, "specularFactor", 1.0f);
    material_.specularColor = vectorOr<3>(specular, "specularColorFactor", vec3(1.0f));
    material_.specularTexture = texture(specular, place, "specularTexture", ColorMeaning::linear);
    material_.specularColorTexture = texture(specular, place, "specularColorTexture", ColorMeaning::srgb);
  }

  void readEmission() {
    const float strength = floatOr(extension("KHR_materials_emissive_strength"), "emissiveStrength", 1.0f);
    material_.emission = vectorOr<3>(json_, "emissiveFactor", vec3(0.0f)) * strength;
    if (material_.emission == vec3(0.0f)) return;
    material_.emissiveTexture = texture(json_, "", "emissiveTexture", ColorMeaning::srgb);
    material_.flags |= kMaterialEmissive;
  }

  void readTransmission(const GltfSource& source) {
    const Json& transmission = extension("KHR_materials_transmission");
    const std::string place = "/extensions/KHR_materials_transmission";
    material_.transmission = floatOr(transmission, "transmissionFactor", 0.0f);
    material_.transmissionTexture = texture(transmission, place, "transmissionTexture", ColorMeaning::linear);
    material_.ior = ior(source);
    const Json& volume = extension("KHR_materials_volume");
    if (numberOr(volume, "thicknessFactor", 0.0) <= 0.0) return;
    material_.flags |= kMaterialSolid;
    material_.absorption =
        absorption(vectorOr<3>(volume, "attenuationColor", vec3(1.0f)), numberOr(volume, "attenuationDistance", 0.0));
  }

  /// KHR_materials_ior: at least 1, or 0 for a surface that reflects all light, here a very dense one.
  float ior(const GltfSource& source) const {
    constexpr float kReflectsAll = 1e4f;
    const float value = floatOr(extension("KHR_materials_ior"), "ior", 1.5f);
    if (value == 0.0f) return kReflectsAll;
    if (value >= 1.0f) return std::min(value, kReflectsAll);
    throw SceneError(fmt::format("ior {} is less than 1", value),
                     source.at(pointer_ + "/extensions/KHR_materials_ior/ior"), "use 1 or more");
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

  void readLayers() {
    const Json& clearcoat = extension("KHR_materials_clearcoat");
    const std::string place = "/extensions/KHR_materials_clearcoat";
    material_.clearcoat = floatOr(clearcoat, "clearcoatFactor", 0.0f);
    material_.clearcoatRoughness = floatOr(clearcoat, "clearcoatRoughnessFactor", 0.0f);
    material_.clearcoatNormalScale = floatOr(member(clearcoat, "clearcoatNormalTexture"), "scale", 1.0f);
    if (material_.clearcoat == 0) return;
    material_.clearcoatNormalTexture = texture(clearcoat, place, "clearcoatNormalTexture", ColorMeaning::linear);
    material_.clearcoatTexture = texture(clearcoat, place, "clearcoatTexture", ColorMeaning::linear);
    material_.clearcoatRoughnessTexture = texture(clearcoat, place, "clearcoatRoughnessTexture", ColorMeaning::linear);
  }

  void readAlpha() {
    const std::string mode = stringOr(json_, "alphaMode", "OPAQUE");
    material_.alphaCutoff = floatOr(json_, "alphaCutoff", 0.5f);
    if (mode == "MASK") material_.flags |= kMaterialAlphaMask;
    if (mode == "BLEND") material_.flags |= kMaterialAlphaBlend;
  }

  const Json& json_;
  std::string pointer_;
  TextureTable& textures_;
  Material material_{};
};

}  // namespace

Material defaultMaterial() {
  Material material{};
  material.baseColor = vec4(1.0f);
  material.metallic = 1.0f;
  material.roughness = 1.0f;
  material.specularColor = vec3(1.0f);
  material.ior = 1.5f;
  material.specular = 1.0f;
  material.normalScale = 1.0f;
  material.clearcoatNormalScale = 1.0f;
  material.alphaCutoff = 0.5f;
  for (uint* texture : {&material.baseColorTexture, &material.metallicRoughnessTexture, &material.normalTexture,
                        &material.emissiveTexture, &material.transmissionTexture, &material.specularTexture,
                        &material.specularColorTexture, &material.clearcoatTexture, &material.clearcoatRoughnessTexture,
                        &material.clearcoatNormalTexture}) {
    *texture = kNone;
  }
  return material;
}

unsigned uvSetsOf(const Material& material, const std::vector<Texture>& textures) {
  unsigned sets = 0;
  for (const uint texture :
       {material.baseColorTexture, material.metallicRoughnessTexture, material.normalTexture, material.emissiveTexture,
        material.transmissionTexture, material.specularTexture, material.specularColorTexture,
        material.clearcoatTexture, material.clearcoatRoughnessTexture, material.clearcoatNormalTexture}) {
    if (texture != kNone) sets |= 1u << textures[texture].uvSet;
  }
  return sets;
}

MaterialSet readMaterials(const GltfDocument& document, const std::vector<bool>& isUsed, Log& log) {
  MaterialSet set;
  set.materialOfFile.assign(isUsed.size(), kNone);
  TextureTable textures(document, log);
  const Json& materials = member(document.json, "materials");
  for (std::size_t i = 0; i < isUsed.size(); ++i) {
    if (!isUsed[i]) continue;
    set.materialOfFile[i] = static_cast<uint>(set.materials.size());
    MaterialReader reader(element(materials, i), fmt::format("/materials/{}", i), textures);
    set.materials.push_back(reader.read(document.source));
    set.names.push_back(stringOr(element(materials, i), "name", ""));
  }
  set.textures = textures.textures();
  set.imageOfTexture = textures.images();
  return set;
}

}  // namespace importon
