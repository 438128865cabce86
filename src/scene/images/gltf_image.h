/// The texels of the images that materials use.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "scene/container/gltf_document.h"
#include "scene/materials/gltf_material.h"
#include "shared/scene_data.h"

namespace importon {

/// The bytes of an image as they stand in the file, not decoded.
[[nodiscard]] std::span<const unsigned char> encodedImage(const tinygltf::Model& model, std::size_t image);

/// Decodes each image that `set` uses once, on all host threads, and gives its textures their place and size in
/// the result (RGBA8). Throws SceneError.
[[nodiscard]] std::vector<uint> loadTexels(const GltfDocument& document, MaterialSet& set);

}  // namespace importon
