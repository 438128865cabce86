/// Puts mesh parts into the scene's arrays: flattened into the world, or once for many instances.
#pragma once
#include <span>
#include <string>

#include "base/log.h"
#include "scene/instances/keep_meshes.h"
#include "scene/scene.h"

namespace importon {

/// Where render space has its origin in a world whose bounds are `low` to `high`: 0 while that is within four
/// scene sizes of the centre (positions then keep the world's float values), else the centre, rounded to float.
/// Scaling the bounds by a power of two scales the result exactly.
[[nodiscard]] glm::dvec3 chooseOrigin(const glm::dvec3& low, const glm::dvec3& high);

/// Fills positions, vertices, triangles, placed, worldFromRender and bounds. Where instances are flattened, a mirroring
/// transform swaps two corners so that counter-clockwise stays the front. Triangles without area or with a corner that
/// isn't finite (or lies beyond 1e15) are dropped with counted warnings. `name` is the file's, for messages. Throws
/// SceneError if nothing is left, or when more than 2^26 triangles or vertices would be flattened.
void assembleGeometry(std::span<const MeshInstance> instances, Scene& scene, const std::string& name, Log& log,
                      const KeepRule& rule = {});

}  // namespace importon
