#include "scene/turntable.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

namespace importon {

using glm::dvec3;

namespace {

/// Where a line meets a surface, m along it.
struct Hit {
  double distance = std::numeric_limits<double>::infinity();
  bool isFront = true;
};

/// What a line of sight meets first, and next behind that.
class Sight {
 public:
  Sight(const dvec3& origin, const dvec3& direction) : origin_(origin), direction_(direction) {}

  /// [Möller and Trumbore 1997, "Fast, minimum storage ray-triangle intersection"], edges included.
  void meet(const dvec3& a, const dvec3& b, const dvec3& c) {
    const dvec3 ab = b - a, ac = c - a, p = glm::cross(direction_, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0) return;
    const dvec3 q = glm::cross(origin_ - a, ab);
    const double u = glm::dot(origin_ - a, p) / determinant, v = glm::dot(direction_, q) / determinant;
    if (u >= 0 && v >= 0 && u + v <= 1) add({glm::dot(ac, q) / determinant, determinant > 0});
  }

  /// A box in a space of its own stands for what is in it.
  void meet(const dvec3& low, const dvec3& high, const glm::dmat4& worldFromBox) {
    const glm::dmat4 boxFromWorld = glm::inverse(worldFromBox);
    const dvec3 from(boxFromWorld * glm::dvec4(origin_, 1)), along(boxFromWorld * glm::dvec4(direction_, 0));
    double begin = 0, end = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const double one = (low[axis] - from[axis]) / along[axis], other = (high[axis] - from[axis]) / along[axis];
      begin = std::fmax(begin, std::fmin(one, other));  // those of a line within a face's plane are NaN
      end = std::fmin(end, std::fmax(one, other));
    }
    if (begin > end) return;
    add({begin, true});
    add({end, false});
  }

  /// The middle of the solid that is met first; of a surface that bounds none, itself. None: nothing is met.
  [[nodiscard]] std::optional<double> lookedAt() {
    std::ranges::sort(hits_, {}, &Hit::distance);
    if (hits_.empty()) return std::nullopt;
    constexpr double kSame = 1e-9;  // of two triangles, at their edge
    const Hit& first = hits_.front();
    for (const Hit& next : hits_)
      if (next.distance > first.distance * (1 + kSame))
        return first.isFront && !next.isFront ? (first.distance + next.distance) / 2 : first.distance;
    return first.distance;
  }

 private:
  void add(const Hit& hit) {
    if (hit.distance > 0 && std::isfinite(hit.distance)) hits_.push_back(hit);
  }

  dvec3 origin_, direction_;
  std::vector<Hit> hits_;
};

std::optional<double> distanceLookedAt(const Scene& scene, const dvec3& origin, const dvec3& direction) {
  Sight sight(origin, direction);
  const auto corner = [&](uint vertex) { return dvec3(scene.positions[vertex]); };
  for (const Triangle& t : scene.worldTriangles()) sight.meet(corner(t.v0), corner(t.v1), corner(t.v2));
  scene.placed.visitPages([&](const PlacedInstance&, const Placement& placement, const MeshPage& page) {
    glm::dmat4 world(placement.linear);
    world[3] = glm::dvec4(placement.translation, 1);
    sight.meet(dvec3(page.low), dvec3(page.high), world);
  });
  return sight.lookedAt();
}

}  // namespace

dvec3 turntableCentre(const Scene& scene, const Camera& camera) {
  const dvec3 middle = (dvec3(scene.boundsMin) + dvec3(scene.boundsMax)) / 2.0 + scene.worldFromRender;
  if (!scene.hasCameraInFile) return middle;
  const dvec3 eye(camera.worldFromCamera[3]), forward = -dvec3(camera.worldFromCamera[2]);
  const std::optional<double> lookedAt = distanceLookedAt(scene, eye - scene.worldFromRender, forward);
  const double distance = lookedAt.value_or(glm::dot(middle - eye, forward));
  return distance > 0 ? eye + distance * forward : middle;
}

Camera turnedAround(const Camera& camera, const dvec3& centre, double turns) {
  const double part = turns - std::floor(turns);
  if (part == 0) return camera;
  const double angle = 2 * std::numbers::pi * part, cosine = std::cos(angle), sine = std::sin(angle);
  const auto turned = [&](const dvec3& v) {
    return dvec3(cosine * v.x + sine * v.z, v.y, cosine * v.z - sine * v.x);  // +z goes to +x
  };
  Camera result = camera;
  for (int axis = 0; axis < 3; ++axis)
    result.worldFromCamera[axis] = glm::dvec4(turned(dvec3(camera.worldFromCamera[axis])), 0);
  result.worldFromCamera[3] = glm::dvec4(centre + turned(dvec3(camera.worldFromCamera[3]) - centre), 1);
  return result;
}

}  // namespace importon
