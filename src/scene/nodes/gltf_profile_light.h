/// EXT_lights_ies.
#pragma once
#include <span>

#include "scene/container/gltf_document.h"
#include "scene/nodes/gltf_nodes.h"
#include "scene/scene.h"

namespace importon {

/// Appends the lights of `nodes` that have a profile, and the profiles as textures, each once. Candela are taken as
/// W/sr. The scene's own textures are there. Throws SceneError where a file is missing or damaged, or there would be
/// more than 2^28 texels.
void addProfileLights(const GltfDocument& document, std::span<const PlacedNode> nodes, Scene& scene, Log& log);

}  // namespace importon
