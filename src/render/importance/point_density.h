/// How densely weighted points lie around a place: enough to choose the size of cells by.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/z_order.h"
#include "scene/scene.h"

namespace importon {

/// Points sorted along a Z-order curve.
class PointDensity {
 public:
  /// `weights`: one per point. Points lie in the cube of edge `extent` (m) at `origin`.
  PointDensity(std::span<const vec3> points, std::span<const float> weights, vec3 origin, float extent);
  /// Weight per m² of a surface at `position`: that in the smallest cube of an octree that holds some points, over the
  /// square of its edge.
  [[nodiscard]] double at(vec3 position) const;

 private:
  vec3 origin_;
  float extent_;
  std::vector<std::uint32_t> codes_;
  std::vector<double> sums_;  // of the weights before each point
};

}  // namespace importon
