#include "scene/meshes/triangulate.h"

namespace importon {
namespace {

/// `index` maps 0 to count - 1 to vertices.
template <typename Index>
std::vector<uvec3> triangulateWith(TriangleMode mode, std::size_t count, Index index) {
  std::vector<uvec3> triangles;
  if (count < 3) return triangles;
  if (mode == TriangleMode::triangles) {
    triangles.reserve(count / 3);
    for (std::size_t i = 0; i + 2 < count; i += 3) triangles.emplace_back(index(i), index(i + 1), index(i + 2));
    return triangles;
  }
  triangles.reserve(count - 2);
  for (std::size_t i = 0; i + 2 < count; ++i) {
    const std::size_t odd = i % 2;
    const uvec3 triangle = mode == TriangleMode::strip ? uvec3(index(i), index(i + 1 + odd), index(i + 2 - odd))
                                                       : uvec3(index(i + 1), index(i + 2), index(0));
    const bool isStitch = triangle.x == triangle.y || triangle.y == triangle.z || triangle.z == triangle.x;
    if (!isStitch) triangles.push_back(triangle);
  }
  return triangles;
}

}  // namespace

std::vector<uvec3> triangulate(TriangleMode mode, const std::vector<uint>& indices) {
  return triangulateWith(mode, indices.size(), [&](std::size_t i) { return indices[i]; });
}

std::vector<uvec3> triangulate(TriangleMode mode, std::size_t count) {
  return triangulateWith(mode, count, [](std::size_t i) { return static_cast<uint>(i); });
}

}  // namespace importon
