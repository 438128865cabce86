/// Materials and the textures they use, without the texels.
#pragma once
#include <string>
#include <vector>

#include "base/log.h"
#include "scene/container/gltf_document.h"
#include "shared/scene_data.h"

namespace importon {

/// A material whose metallicRoughnessTexture holds glossiness (specular_glossiness.h).
struct GlossyMaterial {
  std::size_t material = 0;
  float factor = 1;
};

/// Materials that `isUsed` asks for, in the order of the file.
struct MaterialSet {
  std::vector<Material> materials;
  std::vector<std::string> names;
  std::vector<uint> materialOfFile;         // by index in the file; kNone if not used
  std::vector<Texture> textures;            // firstTexel, width and height still 0
  std::vector<std::size_t> imageOfTexture;  // index in the file
  std::vector<GlossyMaterial> glossiness;
};

/// The material of a primitive that has none (glTF 2.0, section 3.9.7): white, metallic 1, roughness 1.
[[nodiscard]] Material defaultMaterial();

/// Which UV sets the textures of a material read: bit n for set n.
[[nodiscard]] unsigned uvSetsOf(const Material& material, const std::vector<Texture>& textures);

/// True if a material of the file lets light pass into a volume (KHR_materials_volume). `material`: -1 for none.
[[nodiscard]] bool boundsVolume(const GltfDocument& document, int material);

/// Reads the materials with isUsed[i]. Throws SceneError.
[[nodiscard]] MaterialSet readMaterials(const GltfDocument& document, const std::vector<bool>& isUsed, Log& log);

}  // namespace importon
