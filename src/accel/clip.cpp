#include "accel/clip.h"

#include <cmath>

namespace importon {
namespace {

float roundDown(double value) {
  const auto nearest = static_cast<float>(value);
  if (static_cast<double>(nearest) <= value) return nearest;
  return std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}

float roundUp(double value) { return -roundDown(-value); }

}  // namespace

ClippedTriangle::ClippedTriangle(vec3 a, vec3 b, vec3 c) {
  for (const vec3& vertex : {a, b, c}) add(glm::dvec3(vertex));
}

void ClippedTriangle::add(const glm::dvec3& vertex) {
  if (count_ == vertices_.size()) return;  // only rounding makes so many, within rounding of the others
  if (count_ > 0 && vertices_[count_ - 1] == vertex) return;
  vertices_[count_++] = vertex;
}

std::pair<ClippedTriangle, ClippedTriangle> ClippedTriangle::cut(int axis, float plane) const {
  const auto at = static_cast<double>(plane);
  std::pair<ClippedTriangle, ClippedTriangle> parts{ClippedTriangle(), ClippedTriangle()};
  for (std::size_t i = 0; i < count_; ++i) {
    const glm::dvec3& from = vertices_[i];
    const glm::dvec3& to = vertices_[(i + 1) % count_];
    if (from[axis] <= at) parts.first.add(from);
    if (from[axis] >= at) parts.second.add(from);
    if ((from[axis] < at) == (to[axis] < at) || from[axis] == at || to[axis] == at) continue;
    glm::dvec3 crossing = from + (to - from) * ((at - from[axis]) / (to[axis] - from[axis]));
    crossing[axis] = at;
    parts.first.add(crossing);
    parts.second.add(crossing);
  }
  return parts;
}

Box ClippedTriangle::box(const Box& within) const {
  Box box = Box::empty();
  for (std::size_t i = 0; i < count_; ++i) {
    Float4 low{}, high{};
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = roundDown(vertices_[i][axis]);
      high[axis] = roundUp(vertices_[i][axis]);
    }
    box.lo = min4(box.lo, low);
    box.hi = max4(box.hi, high);
  }
  return {max4(box.lo, within.lo), min4(box.hi, within.hi)};
}

float ClippedTriangle::projectedArea() const {
  glm::dvec3 normal(0);
  for (std::size_t i = 2; i < count_; ++i)
    normal += glm::cross(vertices_[i - 1] - vertices_[0], vertices_[i] - vertices_[0]);
  return static_cast<float>(0.5 * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z)));
}

}  // namespace importon
