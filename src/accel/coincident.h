/// Triangles that lie on top of each other.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "shared/scene_data.h"

namespace importon {

/// Indices, ascending, of the triangles that no triangle of smaller index equals in all three vertices,
/// whichever comes first.
[[nodiscard]] std::vector<std::uint32_t> distinctTriangles(std::span<const vec3> positions,
                                                           std::span<const Triangle> triangles);

}  // namespace importon
