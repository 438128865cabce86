/// Which mesh parts a scene keeps once for all their instances, and how it holds them.
#pragma once
#include <functional>
#include <span>
#include <vector>

#include "scene/meshes/gltf_mesh.h"
#include "scene/scene.h"

namespace importon {

struct MeshInstance {
  const MeshPart* part = nullptr;
  glm::dmat4 worldFromObject{1.0};
  uint material = 0;   // index in the scene
  bool emits = false;  // its material does
};

/// A part is kept where flattening it would write at least so many triangles beyond those of the part itself: fewer are
/// traced faster as one tree, and loaded as fast.
struct KeepRule {
  std::size_t leastSaved = 1u << 17;
};

/// Sorts instances into those to flatten and those to place. Flattened are: parts of fewer repeated triangles than the
/// rule says, or of very few, what emits, and instances whose transform cannot be turned round with some accuracy.
/// Refers to `instances`.
class MeshKeeper {
 public:
  MeshKeeper(std::span<const MeshInstance> instances, const KeepRule& rule);

  [[nodiscard]] std::span<const MeshInstance> flat() const { return flat_; }
  /// Adds the boxes of what is placed to bounds in the world.
  void includeKept(glm::dvec3& low, glm::dvec3& high) const;
  /// Makes scene.placed. `append(part, material)` adds a part's triangles in its own space to the scene's and returns
  /// the first of them. Throws SceneError when there are more pages than numbers of triangles can tell.
  void place(Scene& scene, const std::function<std::size_t(const MeshPart&, uint material)>& append) const;

 private:
  struct Kept {
    const MeshPart* part;
    uint material;
    vec3 low, high;
    std::vector<const MeshInstance*> instances;
  };

  std::vector<MeshInstance> flat_;
  std::vector<Kept> kept_;
};

}  // namespace importon
