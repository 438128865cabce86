/// The texels of the images that materials use.
#pragma once
#include <cstddef>
#include <vector>

#include "scene/container/gltf_document.h"
#include "scene/materials/gltf_material.h"
#include "shared/scene_data.h"

namespace importon {

/// Decodes each image that `set` uses once, on all host threads, and gives its textures their place and size in
/// the result: RGBA8, or RGBA16 where the image has it and a texture reads a quantity there (normal, roughness). Throws
/// SceneError.
[[nodiscard]] std::vector<uint> loadTexels(const GltfDocument& document, MaterialSet& set, Log& log);

}  // namespace importon
