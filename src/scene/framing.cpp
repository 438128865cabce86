#include "scene/framing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace importon {
namespace {

using glm::dvec3;

constexpr double kFieldOfView = 0.6;  // radians, high: little perspective, as of a lens for portraits
constexpr double kShown = 0.9;        // share of the image's extent that the scene takes

/// Towards the camera. Azimuth from +z to +x, both in degrees.
dvec3 towards(double azimuth, double elevation) {
  const double a = glm::radians(azimuth), e = glm::radians(elevation);
  return {std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)};
}

/// The way that the surfaces face: the mean normal where they agree; the axis of flat things that have two sides,
/// towards the front, the right or above; else 0.
dvec3 facing(const Scene& scene) {
  constexpr double kAgreeing = 0.5, kFlat = 0.8;
  dvec3 sum(0.0), sizes(0.0);
  double area = 0;
  for (const Triangle& t : scene.worldTriangles()) {
    const dvec3 a(scene.positions[t.v0]);
    const dvec3 normal = glm::cross(dvec3(scene.positions[t.v1]) - a, dvec3(scene.positions[t.v2]) - a);
    sum += normal;
    sizes += glm::abs(normal);
    area += glm::length(normal);
  }
  scene.placed.visitPages([&](const PlacedInstance&, const Placement& placement, const MeshPage& page) {
    const glm::dmat3 cofactors = placement.cofactors();
    sum += 2.0 * (cofactors * page.vectorArea) * (glm::determinant(placement.linear) < 0 ? -1.0 : 1.0);
    area += 2 * page.areas.areaAfter(cofactors);
    for (int axis = 0; axis < 3; ++axis) sizes[axis] += 2 * page.areas.areaSeenAlong(axis, cofactors);
  });
  if (glm::length(sum) > kAgreeing * area) return glm::normalize(sum);
  for (int axis = 0; axis < 3; ++axis) {
    dvec3 unit(0.0);
    unit[axis] = 1;
    if (sizes[axis] > kFlat * area) return unit;
  }
  return dvec3(0.0);
}

/// The first of these views that sees well what faces one way; the first if nothing does.
dvec3 viewOf(const Scene& scene) {
  constexpr double kSide = 32, kAbove = 17, kHighAbove = 40, kSeenWell = 0.35;  // degrees; a cosine
  constexpr std::array kAzimuths{kSide, -kSide, 180 - kSide, kSide - 180};
  constexpr std::array kElevations{kAbove, kHighAbove, -kHighAbove};
  const dvec3 normal = facing(scene);
  for (const double elevation : kElevations)
    for (const double azimuth : kAzimuths)
      if (glm::dot(normal, towards(azimuth, elevation)) > kSeenWell) return towards(azimuth, elevation);
  return towards(kSide, kAbove);
}

/// How far the camera must be, and how far to the side, so that points fit between two planes through it: with x to the
/// side, z towards the camera, both of a point, and the tangent t of half the angle between them, |x - side| <= t (back
/// - z).
struct Fit {
  double low = -std::numeric_limits<double>::infinity(), high = low;

  void add(double x, double z, double tangent) {
    low = std::max(low, z * tangent - x);
    high = std::max(high, z * tangent + x);
  }
  [[nodiscard]] double back(double tangent) const { return (low + high) / (2 * tangent); }
  [[nodiscard]] double side() const { return (high - low) / 2; }
};

/// Calls `visit` with points, in render space, whose hull all triangles lie in.
template <class Visit>
void visitPoints(const Scene& scene, const Visit& visit) {
  for (const Triangle& t : scene.worldTriangles())
    for (const uint vertex : {t.v0, t.v1, t.v2}) visit(dvec3(scene.positions[vertex]));
  scene.placed.visitPages([&](const PlacedInstance&, const Placement& placement, const MeshPage& page) {
    for (uint corner = 0; corner < 8; ++corner)
      visit(placement(vec3((corner & 1u) != 0 ? page.high.x : page.low.x, (corner & 2u) != 0 ? page.high.y : page.low.y,
                           (corner & 4u) != 0 ? page.high.z : page.low.z)));
  });
}

/// A camera that looks towards the scene from where `backward` points to, before it is placed.
struct View {
  View(const Scene& scene, double aspect)
      : backward(viewOf(scene)),
        right(glm::normalize(glm::cross(dvec3(0, 1, 0), backward))),
        up(glm::cross(backward, right)),
        high(kShown * std::tan(kFieldOfView / 2)),
        wide(high * aspect) {
    camera.name = "frame";
    camera.yfov = kFieldOfView;
    camera.aspectRatio = aspect;
  }

  void add(const dvec3& p) {
    across.add(glm::dot(p, right), glm::dot(p, backward), wide);
    along.add(glm::dot(p, up), glm::dot(p, backward), high);
  }
  /// So that all points fit, relative to `origin`.
  [[nodiscard]] Camera placed(const dvec3& origin) {
    const double back = std::max(across.back(wide), along.back(high));
    const dvec3 eye = right * across.side() + up * along.side() + backward * back + origin;
    camera.worldFromCamera =
        glm::dmat4(glm::dvec4(right, 0), glm::dvec4(up, 0), glm::dvec4(backward, 0), glm::dvec4(eye, 1));
    return camera;
  }

  Camera camera;
  dvec3 backward, right, up;
  double high, wide;  // tangents of half the angles that the scene may take
  Fit across, along;
};

/// The farthest that points are from the y axis, in slices of their heights.
class Profile {
 public:
  Profile(double low, double high) : low_(low), step_((high - low) / kSlices) {}

  void add(const dvec3& p) {
    const double slice = step_ > 0 ? (p.y - low_) / step_ : 0;
    double& radius = radii_[static_cast<std::size_t>(std::clamp(slice, 0.0, kSlices - 1.0))];
    radius = std::max(radius, std::hypot(p.x, p.z));
  }
  /// Points whose hull all lie in, however they are turned.
  template <class Visit>
  void visit(const Visit& visit) const {
    const double bulge = 1 / std::cos(std::numbers::pi / kSides);  // of a polygon around the circle
    for (std::size_t slice = 0; slice < radii_.size(); ++slice) {
      if (radii_[slice] < 0) continue;
      for (int side = 0; side < kSides; ++side) {
        const double angle = 2 * std::numbers::pi * side / kSides, radius = bulge * radii_[slice];
        for (const double edge : {0.0, 1.0})
          visit(dvec3(radius * std::cos(angle), low_ + (static_cast<double>(slice) + edge) * step_,
                      radius * std::sin(angle)));
      }
    }
  }

 private:
  static constexpr int kSlices = 64, kSides = 64;
  double low_, step_;
  std::array<double, kSlices> radii_ = [] {
    std::array<double, kSlices> none{};
    none.fill(-1);
    return none;
  }();
};

}  // namespace

Camera framingCamera(const Scene& scene, double aspect) {
  View view(scene, aspect);
  visitPoints(scene, [&](const dvec3& p) { view.add(p); });
  return view.placed(scene.worldFromRender);
}

Camera roundFramingCamera(const Scene& scene, double aspect) {
  const dvec3 low(scene.boundsMin), high(scene.boundsMax), axis((low.x + high.x) / 2, 0, (low.z + high.z) / 2);
  Profile profile(low.y, high.y);
  visitPoints(scene, [&](const dvec3& p) { profile.add(p - axis); });
  View view(scene, aspect);
  profile.visit([&](const dvec3& p) { view.add(p); });
  return view.placed(axis + scene.worldFromRender);
}

}  // namespace importon
