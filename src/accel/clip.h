/// Parts of triangles between axis-parallel planes.
#pragma once
#include <array>
#include <utility>

#include "accel/box.h"

namespace importon {

/// A convex polygon: a triangle, cut by up to six planes, one for each side of a box.
class ClippedTriangle {
 public:
  ClippedTriangle(vec3 a, vec3 b, vec3 c);

  /// The parts below and above the plane where `axis` has the value `plane`; what lies in it belongs to both.
  [[nodiscard]] std::pair<ClippedTriangle, ClippedTriangle> cut(int axis, float plane) const;
  /// The least box of floats that holds it, as far as `within` reaches.
  [[nodiscard]] Box box(const Box& within) const;
  /// Sum of the areas of its projections along the axes, to which the half areas of ever smaller boxes around
  /// its points add up.
  [[nodiscard]] float projectedArea() const;
  [[nodiscard]] bool isEmpty() const { return count_ == 0; }

 private:
  static constexpr std::size_t kMaxVertices = 9;
  ClippedTriangle() = default;
  void add(const glm::dvec3& vertex);

  std::array<glm::dvec3, kMaxVertices + 3> vertices_;  // a few more, as rounding may repeat some
  std::size_t count_ = 0;
};

}  // namespace importon
