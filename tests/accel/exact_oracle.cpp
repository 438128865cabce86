#include "accel/exact_oracle.h"

#include <algorithm>
#include <limits>

namespace importon::test {

NearestHit nearestHit(const Mesh& mesh, const Ray& ray, double slack) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  NearestHit nearest{kInfinity, kInfinity};
  const glm::dvec3 origin(ray.origin), direction(ray.direction);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::dvec3 a = glm::dvec3(mesh.vertex(i, 0)) - origin, b = glm::dvec3(mesh.vertex(i, 1)) - origin,
                     c = glm::dvec3(mesh.vertex(i, 2)) - origin;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double facing = glm::dot(normal, direction);
    if (facing == 0) continue;
    const double t = glm::dot(normal, a) / facing;
    const double u = glm::dot(glm::cross(c, b), direction), v = glm::dot(glm::cross(a, c), direction),
                 w = glm::dot(glm::cross(b, a), direction), total = u + v + w;
    const double inside = std::min({u / total, v / total, w / total});
    if (!(inside >= -slack) || !(t > -slack * glm::length(a))) continue;
    nearest.possible = std::min(nearest.possible, t);
    if (inside >= slack && t > slack * glm::length(a)) nearest.certain = std::min(nearest.certain, t);
  }
  return nearest;
}

}  // namespace importon::test
