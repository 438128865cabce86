/// Triangle meshes and rays for tests of the BVH.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "shared/ray_data.h"
#include "shared/scene_data.h"

namespace importon::test {

/// Triangles of three vertices of their own, or with shared vertices.
struct Mesh {
  std::vector<vec3> positions;
  std::vector<Triangle> triangles;

  void add(vec3 a, vec3 b, vec3 c);
  [[nodiscard]] vec3 vertex(std::size_t triangle, int corner) const;
};

/// Triangles of random place and shape, edges about `size`, in the unit cube.
[[nodiscard]] Mesh randomTriangles(std::size_t count, float size, std::uint32_t seed);
/// Triangles of random place and direction in the unit cube, about 0.6 long and a hundredth of it wide, among
/// ten times as many tiny ones.
[[nodiscard]] Mesh slats(std::size_t count, std::uint32_t seed);
/// A wavy height field of 2·cells² triangles over the unit square, vertices shared.
[[nodiscard]] Mesh heightField(std::uint32_t cells);
/// A box of 12 triangles, vertices shared.
[[nodiscard]] Mesh closedBox(vec3 low, vec3 high);
/// A sphere of `rings` times 2·rings quads, those at the poles triangles; vertices shared.
[[nodiscard]] Mesh closedSphere(vec3 centre, float radius, uint rings);

/// From points on the triangles' surfaces, moved off by a little, into random directions of that side.
[[nodiscard]] std::vector<Ray> surfaceRays(const Mesh& mesh, std::size_t count, std::uint32_t seed);
/// Between points on the surfaces, moved off by a little: for shadow tests.
[[nodiscard]] std::vector<Ray> segmentRays(const Mesh& mesh, std::size_t count, std::uint32_t seed);
/// From points around the mesh along the six axis directions.
[[nodiscard]] std::vector<Ray> axisRays(const Mesh& mesh, std::size_t count, std::uint32_t seed);
/// From points around the mesh straight at its vertices and at points on its edges.
[[nodiscard]] std::vector<Ray> grazingRays(const Mesh& mesh, std::size_t count, std::uint32_t seed);

}  // namespace importon::test
