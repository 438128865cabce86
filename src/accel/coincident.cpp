#include "accel/coincident.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

namespace importon {
namespace {

using Vertex3 = std::array<std::uint32_t, 3>;
using Key = std::array<Vertex3, 3>;

/// The bits of the vertices in ascending order; -0 counts as 0.
Key makeKey(std::span<const vec3> positions, const Triangle& triangle) {
  const auto bits = [&](uint vertex) {
    const vec3 p = positions[vertex] + 0.0f;
    return Vertex3{std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y),
                   std::bit_cast<std::uint32_t>(p.z)};
  };
  Key key{bits(triangle.v0), bits(triangle.v1), bits(triangle.v2)};
  std::sort(key.begin(), key.end());
  return key;
}

}  // namespace

std::vector<std::uint32_t> distinctTriangles(std::span<const vec3> positions, std::span<const Triangle> triangles) {
  std::vector<Key> keys(triangles.size());
  std::transform(triangles.begin(), triangles.end(), keys.begin(),
                 [&](const Triangle& triangle) { return makeKey(positions, triangle); });
  std::vector<std::uint32_t> order(triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return keys[a] != keys[b] ? keys[a] < keys[b] : a < b; });
  const auto end =
      std::unique(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return keys[a] == keys[b]; });
  order.erase(end, order.end());
  std::sort(order.begin(), order.end());
  return order;
}

}  // namespace importon
