#include "scene/studio.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/environment.h"
#include "scene/light_math.h"

namespace importon {
namespace {

using glm::dvec3;

/// A soft box at infinity: a rectangle in the plane that touches the sphere of directions at its middle, with round
/// corners and an edge that fades out.
struct SoftBox {
  double azimuth, elevation;     // degrees; 0: +z, 90: +x
  double halfWidth, halfHeight;  // tangents of half its extent, to the middle of its edge
  double softness;               // width of the edge over the half extent
  double radiance;               // W/(m² sr) above the gradient's
};

constexpr std::array kBoxes{SoftBox{-40, 45, 0.62, 0.5, 0.7, 2.75},   // key
                            SoftBox{70, 18, 0.7, 0.8, 0.8, 0.65},     // fill
                            SoftBox{165, 38, 0.8, 0.22, 0.8, 2.25}};  // rim

double smoothStep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double lightOf(const SoftBox& box, const dvec3& direction) {
  const double azimuth = glm::radians(box.azimuth), elevation = glm::radians(box.elevation);
  const dvec3 middle(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                     std::cos(elevation) * std::cos(azimuth));
  const double ahead = glm::dot(direction, middle);
  if (!(ahead > 0)) return 0;
  const dvec3 right(std::cos(azimuth), 0, -std::sin(azimuth));
  const double x = glm::dot(direction, right) / (ahead * box.halfWidth);
  const double y = glm::dot(direction, glm::cross(middle, right)) / (ahead * box.halfHeight);
  constexpr double kRoundness = 4;  // of a superellipse: 2 is an ellipse
  const double edge = std::pow(std::pow(std::abs(x), kRoundness) + std::pow(std::abs(y), kRoundness), 1 / kRoundness);
  return box.radiance * (1 - smoothStep(1 - 0.5 * box.softness, 1 + 0.5 * box.softness, edge));
}

/// A dark floor, brighter towards the horizon, and a bright ceiling: no line between them.
double gradient(double up) {
  constexpr double kNadir = 0.035, kHorizon = 0.1, kZenith = 0.4;
  return up < 0 ? kNadir + (kHorizon - kNadir) * smoothStep(-0.8, 0, up)
                : kHorizon + (kZenith - kHorizon) * smoothStep(0, 1, up);
}

}  // namespace

EnvironmentMap studioEnvironment() {
  constexpr int kHeight = 128;
  return mapOf(kHeight, [](const dvec3& direction) {
    double radiance = gradient(direction.y);
    for (const SoftBox& box : kBoxes) radiance += lightOf(box, direction);
    return dvec3(radiance);
  });
}

bool isGlowingModel(const Scene& scene) {
  return !scene.hasCameraInFile &&
         std::ranges::all_of(scene.lights, [](const Light& light) { return light.kind == kLightTriangle; });
}

bool isAsGoodAsUnlit(const Scene& scene) {
  constexpr double kGrey = 0.18, kFirstStep = 1 / (255 * 12.92);  // linear, by IEC 61966-2-1
  return std::all_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
    return light.kind == kLightTriangle && kGrey * meanOf(light.emission) < kFirstStep;
  });
}

}  // namespace importon
