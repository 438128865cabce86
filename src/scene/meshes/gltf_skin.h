/// Skinned meshes in the pose that the joints' own transforms give.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "scene/meshes/gltf_mesh.h"
#include "scene/nodes/gltf_nodes.h"

namespace importon {

/// worldFromObject for each joint of a skin: the joint's world transform times its inverse bind matrix.
struct SkinPose {
  std::vector<glm::dmat4> worldFromObject;
  std::string pointer;  // of the skin
};

/// `placedNodes`: by index in the file, null if not in the scene. Throws SceneError if a joint is not.
[[nodiscard]] SkinPose readSkinPose(const GltfDocument& document, std::size_t skin,
                                    std::span<const PlacedNode* const> placedNodes);

/// The part in world space, each vertex moved by the weighted mean of its joints' matrices, those of all its sets (glTF
/// 2.0, section 3.7.3.3). Vertices without weights follow the first joint. Throws SceneError.
[[nodiscard]] MeshPart posePart(const MeshPart& part, const SkinPose& pose, const GltfSource& source);

}  // namespace importon
