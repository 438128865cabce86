/// KHR_materials_pbrSpecularGlossiness in terms of our material.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/materials/gltf_material.h"

namespace importon {

/// Rewrites each material that has the extension: its diffuse colour is the base colour of a dielectric of ior 1.5, its
/// specular colour over 0.04 is the specular colour of KHR_materials_specular, so that the reflectance at normal
/// incidence is exactly what the extension says, and 1 - glossiness is the roughness. The document has passed
/// checkSchema.
void convertSpecularGlossiness(nlohmann::json& document);

/// The factor of the glossiness that a material, rewritten so, has in the alpha of its metallicRoughnessTexture; empty:
/// that is an ordinary one.
[[nodiscard]] std::optional<float> glossinessFactorOf(const nlohmann::json& material);

/// Gives the materials of set.glossiness textures of roughness instead: of each texel, 1 - factor · alpha in green,
/// from and to RGBA8, behind `texels`. Throws SceneError, at `name`, where there would be more texels than 2^28.
void makeRoughnessTextures(MaterialSet& set, std::vector<uint>& texels, const std::string& name);

}  // namespace importon
