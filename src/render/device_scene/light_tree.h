/// A binary tree over the lights of a scene (lib/light_tree.glsl).
#pragma once
#include <span>
#include <vector>

#include "scene/scene.h"

namespace importon {

/// Where a light is and where it sends its power.
struct LightBounds {
  vec3 low{0.0f}, high{0.0f};  // m, render space
  vec3 axis{0.0f, 0.0f, 1.0f};
  float cosCone = -1;  // of the half-angle around the axis that holds all directions of strongest emission
  float power = 0;     // W; of infinite lights the irradiance that they bring, W/m²
  bool isInfinite = false;
};

/// Bounds of `light`, with its device data (centroid, normal and sidedness) filled in.
[[nodiscard]] LightBounds boundLight(const Scene& scene, const Light& light);

/// Texels of the tree over at least one light: depth at most 2 + log2 of their number.
[[nodiscard]] std::vector<uvec4> buildLightTree(std::span<const LightBounds> lights);

}  // namespace importon
