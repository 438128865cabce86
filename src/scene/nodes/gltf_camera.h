/// Cameras in the world.
#pragma once
#include <span>
#include <vector>

#include "scene/container/gltf_document.h"
#include "scene/nodes/gltf_nodes.h"
#include "scene/scene.h"

namespace importon {

/// The cameras of `nodes`, in the order of the file's cameras; one that several nodes place comes several
/// times. Throws SceneError.
[[nodiscard]] std::vector<Camera> readCameras(const GltfDocument& document, std::span<const PlacedNode> nodes);

}  // namespace importon
