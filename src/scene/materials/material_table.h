/// The fields of a material as a table: where each stands in glTF, what it is where the file does not say, and what it
/// may be. From a row follow the reader, the checks of the file, and who uses which textures.
#pragma once
#include <array>
#include <limits>
#include <string_view>
#include <variant>

#include "shared/scene_data.h"

namespace importon {

enum class ColorMeaning { linear, srgb };

/// A texture that multiplies a factor, or tells a normal.
struct MaterialTexture {
  uint Material::*index;
  ColorMeaning meaning;
  bool (*isNeeded)(const Material&);  // what it is multiplied with is not 0; null: always
};

struct MaterialRow {
  std::string_view place;  // of the object that has it, below the material; keys separated by '/'
  std::string_view key;
  std::variant<float Material::*, vec3 Material::*, vec4 Material::*, MaterialTexture> field;
  float otherwise = 0;  // of each component
  double least = 0, most = 1;
};

inline constexpr double kAnything = std::numeric_limits<double>::infinity();
inline constexpr double kBrightestFactor = 1e18;  // of a factor: products of two stay finite as floats

namespace material_table {

inline constexpr std::string_view kPbr = "pbrMetallicRoughness";
inline constexpr std::string_view kSpecular = "extensions/KHR_materials_specular";
inline constexpr std::string_view kTransmission = "extensions/KHR_materials_transmission";
inline constexpr std::string_view kClearcoat = "extensions/KHR_materials_clearcoat";
inline constexpr std::string_view kDiffuseTransmission = "extensions/KHR_materials_diffuse_transmission";
inline constexpr std::string_view kSheen = "extensions/KHR_materials_sheen";
inline constexpr std::string_view kAnisotropy = "extensions/KHR_materials_anisotropy";
inline constexpr std::string_view kIridescence = "extensions/KHR_materials_iridescence";
inline constexpr std::string_view kDispersion = "extensions/KHR_materials_dispersion";
inline constexpr std::string_view kVolume = "extensions/KHR_materials_volume";

constexpr MaterialRow texture(std::string_view place, std::string_view key, uint Material::*index, ColorMeaning meaning,
                              bool (*isNeeded)(const Material&) = nullptr) {
  return {place, key, MaterialTexture{index, meaning, isNeeded}};
}
inline bool emits(const Material& m) { return m.emission != vec3(0.0f); }
inline bool isCoated(const Material& m) { return m.clearcoat != 0; }
inline bool transmitsDiffusely(const Material& m) { return m.diffuseTransmission != 0; }
inline bool hasSheen(const Material& m) { return m.sheenColor != vec3(0.0f); }
inline bool isAnisotropic(const Material& m) { return m.anisotropy != 0; }
inline bool isIridescent(const Material& m) { return m.iridescence != 0; }
inline bool isThick(const Material& m) { return m.thickness != 0; }
/// Smooth and thin wherever its textures are: light that it transmits goes straight on, so that shadow rays may pass.
inline bool isPane(const Material& m) {
  constexpr float kSmoothAlpha = 1e-3f;  // shaders/lib/albedo.glsl; textures only lower roughness
  return m.transmission > 0 && (m.flags & (kMaterialSolid | kMaterialUnlit)) == 0 &&
         m.roughness * m.roughness < kSmoothAlpha && !isAnisotropic(m);
}

}  // namespace material_table

/// Fields that are made of several values of the file are not here: absorption, ior, flags (gltf_material.cpp).
[[nodiscard]] inline const auto& materialRows() {
  using namespace material_table;
  using enum ColorMeaning;
  using M = Material;
  static const std::array kRows{
      MaterialRow{kPbr, "baseColorFactor", &M::baseColor, 1},
      MaterialRow{kPbr, "metallicFactor", &M::metallic, 1},
      MaterialRow{kPbr, "roughnessFactor", &M::roughness, 1},
      texture(kPbr, "baseColorTexture", &M::baseColorTexture, srgb),
      texture(kPbr, "metallicRoughnessTexture", &M::metallicRoughnessTexture, linear),
      texture("", "normalTexture", &M::normalTexture, linear),
      MaterialRow{"normalTexture", "scale", &M::normalScale, 1, -kAnything, kAnything},
      MaterialRow{kSpecular, "specularFactor", &M::specular, 1},
      MaterialRow{kSpecular, "specularColorFactor", &M::specularColor, 1, 0, kAnything},
      texture(kSpecular, "specularTexture", &M::specularTexture, linear),
      texture(kSpecular, "specularColorTexture", &M::specularColorTexture, srgb),
      MaterialRow{"", "emissiveFactor", &M::emission, 0, 0, kBrightestFactor},
      texture("", "emissiveTexture", &M::emissiveTexture, srgb, emits),
      MaterialRow{kTransmission, "transmissionFactor", &M::transmission},
      texture(kTransmission, "transmissionTexture", &M::transmissionTexture, linear),
      MaterialRow{kClearcoat, "clearcoatFactor", &M::clearcoat},
      MaterialRow{kClearcoat, "clearcoatRoughnessFactor", &M::clearcoatRoughness},
      texture(kClearcoat, "clearcoatNormalTexture", &M::clearcoatNormalTexture, linear, isCoated),
      MaterialRow{"extensions/KHR_materials_clearcoat/clearcoatNormalTexture", "scale", &M::clearcoatNormalScale, 1,
                  -kAnything, kAnything},
      texture(kClearcoat, "clearcoatTexture", &M::clearcoatTexture, linear, isCoated),
      texture(kClearcoat, "clearcoatRoughnessTexture", &M::clearcoatRoughnessTexture, linear, isCoated),
      MaterialRow{kDiffuseTransmission, "diffuseTransmissionFactor", &M::diffuseTransmission},
      MaterialRow{kDiffuseTransmission, "diffuseTransmissionColorFactor", &M::diffuseTransmissionColor, 1},
      texture(kDiffuseTransmission, "diffuseTransmissionTexture", &M::diffuseTransmissionTexture, linear,
              transmitsDiffusely),
      texture(kDiffuseTransmission, "diffuseTransmissionColorTexture", &M::diffuseTransmissionColorTexture, srgb,
              transmitsDiffusely),
      MaterialRow{kSheen, "sheenColorFactor", &M::sheenColor},
      MaterialRow{kSheen, "sheenRoughnessFactor", &M::sheenRoughness},
      texture(kSheen, "sheenColorTexture", &M::sheenColorTexture, srgb, hasSheen),
      texture(kSheen, "sheenRoughnessTexture", &M::sheenRoughnessTexture, linear, hasSheen),
      MaterialRow{kAnisotropy, "anisotropyStrength", &M::anisotropy},
      MaterialRow{kAnisotropy, "anisotropyRotation", &M::anisotropyRotation, 0, -kAnything, kAnything},
      texture(kAnisotropy, "anisotropyTexture", &M::anisotropyTexture, linear, isAnisotropic),
      MaterialRow{kIridescence, "iridescenceFactor", &M::iridescence},
      MaterialRow{kIridescence, "iridescenceIor", &M::iridescenceIor, 1.3f, 1, kAnything},
      MaterialRow{kIridescence, "iridescenceThicknessMinimum", &M::iridescenceThicknessMinimum, 100, 0, kAnything},
      MaterialRow{kIridescence, "iridescenceThicknessMaximum", &M::iridescenceThicknessMaximum, 400, 0, kAnything},
      texture(kIridescence, "iridescenceTexture", &M::iridescenceTexture, linear, isIridescent),
      texture(kIridescence, "iridescenceThicknessTexture", &M::iridescenceThicknessTexture, linear, isIridescent),
      MaterialRow{kDispersion, "dispersion", &M::dispersion, 0, 0, kAnything},
      MaterialRow{kVolume, "thicknessFactor", &M::thickness, 0, 0, kAnything},
      texture(kVolume, "thicknessTexture", &M::thicknessTexture, linear, isThick),
      MaterialRow{"", "alphaCutoff", &M::alphaCutoff, 0.5f, 0, kAnything}};
  return kRows;
}

/// Calls `visit` with the index of each texture, kNone or not.
template <class Visit>
void visitTextures(const Material& material, Visit visit) {
  for (const MaterialRow& row : materialRows())
    if (const auto* texture = std::get_if<MaterialTexture>(&row.field)) visit(material.*texture->index);
}

}  // namespace importon
