/// EXT_mesh_gpu_instancing.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "scene/container/gltf_document.h"

namespace importon {

/// nodeFromInstance for each instance of a node's mesh: T R S of the attributes TRANSLATION, ROTATION and SCALE, which
/// may be normalised integers. The identity alone where the node has no instances. Other attributes are passed over.
/// Throws SceneError where the attributes differ in length.
[[nodiscard]] std::vector<glm::dmat4> readInstances(const GltfDocument& document, std::size_t node);

}  // namespace importon
