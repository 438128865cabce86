/// The node hierarchy, flattened.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "scene/container/gltf_document.h"

namespace importon {

/// A node that the scene reaches.
struct PlacedNode {
  std::size_t node = 0;
  glm::dmat4 worldFromObject{1.0};  // affine
  bool isHidden = false;            // its mesh and light are not drawn; joints and cameras work
};

/// The scene to show: the file's default, else its first; kNoScene when the file has no scene.
inline constexpr std::size_t kNoScene = static_cast<std::size_t>(-1);
[[nodiscard]] std::size_t defaultScene(const GltfDocument& document);

/// All nodes of the default scene (without one: of all roots), parents first, in the order of the file. Throws
/// SceneError if the hierarchy is no forest (a cycle, a node with two parents) or a transform is none.
[[nodiscard]] std::vector<PlacedNode> placeNodes(const GltfDocument& document);

}  // namespace importon
