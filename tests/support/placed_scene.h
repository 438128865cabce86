/// Scenes with a mesh that stands in many places: held once, or flattened.
#pragma once
#include <span>

#include "scene/scene.h"

namespace importon::test {

enum class Held { once, flattened };

/// `world`, and all triangles of `object`, which do not emit, at each of `worldFromObject`, with the materials of both.
/// Neither lies far from the origin.
[[nodiscard]] Scene withInstances(const Scene& world, const Scene& object, std::span<const glm::dmat4> worldFromObject,
                                  Held held);

/// `count` transforms with rotations about any axis, sizes from 0.5 to 1.5 that differ between axes if `isStretched`,
/// and every other one mirrored; places on a grid in the plane y = 0, `distance` apart, its middle at the origin.
[[nodiscard]] std::vector<glm::dmat4> scattered(std::size_t count, double distance, bool isStretched);

}  // namespace importon::test
