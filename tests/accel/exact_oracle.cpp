#include "accel/exact_oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace importon::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// How far inside the triangle of `corners` (relative to its origin) the ray passes, as the least of its
/// distances from the edges; negative outside.
double depthInside(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& direction) {
  std::array<double, 3> areas{};
  double total = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    areas[i] = glm::dot(glm::cross(corners[(i + 2) % 3], corners[(i + 1) % 3]), direction);
    total += areas[i];
  }
  double depth = kInfinity;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 edge = corners[(i + 2) % 3] - corners[(i + 1) % 3];
    const double width = glm::length(edge - direction * glm::dot(edge, direction));
    depth = std::min(depth, (total < 0 ? -areas[i] : areas[i]) / std::max(width, 1e-300));
  }
  return depth;
}

}  // namespace

NearestHit nearestHit(const Mesh& mesh, const Ray& ray, double rounding) {
  NearestHit nearest{kInfinity, kInfinity};
  const glm::dvec3 origin(ray.origin), direction = glm::normalize(glm::dvec3(ray.direction));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::array<glm::dvec3, 3> corners;
    double low = kInfinity, high = -kInfinity, farthest = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      corners[c] = glm::dvec3(mesh.vertex(i, static_cast<int>(c))) - origin;
      low = std::min(low, glm::dot(corners[c], direction));
      high = std::max(high, glm::dot(corners[c], direction));
      farthest = std::max(farthest, glm::length(corners[c]));
    }
    const double width = rounding * farthest, depth = depthInside(corners, direction);
    if (depth < -width || high < -width) continue;
    const glm::dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    const double facing = glm::dot(normal, direction);
    const double t = glm::clamp(glm::dot(normal, corners[0]) / facing, low, high);
    const double error = std::min(width / std::abs(facing), high - low) + width;
    if (t + error < 0) continue;
    nearest.possible = std::min(nearest.possible, t - error);
    if (depth > width && t - error > 0) nearest.certain = std::min(nearest.certain, t + error);
  }
  return nearest;
}

}  // namespace importon::test
