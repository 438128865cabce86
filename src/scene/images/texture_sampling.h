/// Texture lookups on the host, for means over triangles.
#pragma once
#include <cstddef>
#include <span>

#include "shared/scene_data.h"

namespace importon {

/// Where a texture is read for coordinates of its UV set: after its transform, not yet wrapped.
[[nodiscard]] vec2 transformUv(const Texture& texture, const vec2& uv);

/// The linear RGBA of the texel `index`, counted in rows from the top.
[[nodiscard]] vec4 texelAt(const Texture& texture, std::span<const uint> texels, std::size_t index);

/// The linear RGBA of the texel that holds `uv`, which transformUv gave.
[[nodiscard]] vec4 nearestTexel(const Texture& texture, std::span<const uint> texels, const vec2& uv);

/// A texture on a triangle.
class TriangleTexture {
 public:
  /// `uv`: of the corners, of the texture's UV set.
  TriangleTexture(const Texture& texture, std::span<const uint> texels, const vec2 (&uv)[3]);

  /// The linear RGBA at barycentric weights (1 - u - v, u, v).
  [[nodiscard]] vec4 at(float u, float v) const { return nearestTexel(*texture_, texels_, a_ + e1_ * u + e2_ * v); }
  /// Samples along a side that are about as fine as the texels, 64 at most.
  [[nodiscard]] int samplesPerSide() const;

 private:
  const Texture* texture_;
  std::span<const uint> texels_;
  vec2 a_, e1_, e2_;
};

/// The mean of f(u, v) over the points (1 - u - v, u, v) of a triangle: at the centroids of the side² equal ones that
/// it is cut into.
template <class F>
[[nodiscard]] glm::dvec3 meanOverTriangle(int side, F f) {
  glm::dvec3 sum(0.0);
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side - row; ++column) {
      for (int down = 0; down <= (column + 1 < side - row ? 1 : 0); ++down) {  // pointing up and down in turn
        const float centroid = down == 0 ? 1.0f / 3.0f : 2.0f / 3.0f;
        const float u = (static_cast<float>(column) + centroid) / static_cast<float>(side);
        const float v = (static_cast<float>(row) + centroid) / static_cast<float>(side);
        sum += glm::dvec3(f(u, v));
      }
    }
  }
  return sum / (static_cast<double>(side) * side);
}

}  // namespace importon
