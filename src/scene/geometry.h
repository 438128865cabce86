/// Puts instances of mesh parts into the scene's flat arrays, in render space.
#pragma once
#include <span>
#include <string>

#include "base/log.h"
#include "scene/meshes/gltf_mesh.h"
#include "scene/scene.h"

namespace importon {

struct MeshInstance {
  const MeshPart* part = nullptr;
  glm::dmat4 worldFromObject{1.0};
  uint material = 0;  // index in the scene
};

/// Where render space has its origin in a world whose bounds are `low` to `high`: 0 while that is within four
/// scene sizes of the centre (positions then keep the world's float values), else the centre, rounded to float.
/// Scaling the bounds by a power of two scales the result exactly.
[[nodiscard]] glm::dvec3 chooseOrigin(const glm::dvec3& low, const glm::dvec3& high);

/// Fills positions, vertices, triangles, worldFromRender and bounds. A mirroring transform swaps two corners so
/// that counter-clockwise stays the front. Triangles without area or with a corner that isn't finite (or lies
/// beyond 1e15) are dropped with counted warnings. `name` is the file's, for messages. Throws SceneError if
/// nothing is left.
void assembleGeometry(std::span<const MeshInstance> instances, Scene& scene, const std::string& name, Log& log);

}  // namespace importon
