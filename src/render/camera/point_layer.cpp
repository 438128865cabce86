#include "render/camera/point_layer.h"

#include <cmath>
#include <optional>

namespace importon {
namespace {

/// Index of the film's pixel that a point projects to, by the inverse of lib/camera.glsl.
std::optional<std::size_t> pixelOf(const vec3& position, const Parameters& camera, float& depth) {
  const vec3 offset = position - camera.cameraOrigin;
  depth = glm::dot(offset, camera.cameraForward);
  if (depth <= 0) return {};
  const float scale = camera.cameraIsOrthographic != 0 ? 1 : depth;
  const float x = glm::dot(offset, camera.cameraRight) / (scale * glm::dot(camera.cameraRight, camera.cameraRight));
  const float y = glm::dot(offset, camera.cameraUp) / (scale * glm::dot(camera.cameraUp, camera.cameraUp));
  if (!(std::abs(x) < 1 && std::abs(y) < 1)) return {};
  // What lies before the film's corner wraps around to beyond its size.
  const uint column = static_cast<uint>(0.5f * (x + 1) * static_cast<float>(camera.imageSize.x)) - camera.filmCorner.x;
  const uint row = static_cast<uint>(0.5f * (1 - y) * static_cast<float>(camera.imageSize.y)) - camera.filmCorner.y;
  if (column >= camera.width || row >= camera.height) return {};
  return std::size_t{row} * camera.width + column;
}

/// True if the point lies on the surface that the pixel's middle shows: within two pixels of its tangent plane.
bool isOnSeenSurface(const MapPoint& point, std::span<const float> aov, float depth, const Parameters& camera) {
  if (!std::isfinite(aov[kAovDepth])) return false;
  const vec3 seen(aov[kAovPosition], aov[kAovPosition + 1], aov[kAovPosition + 2]);
  const vec3 normal(aov[kAovNormal], aov[kAovNormal + 1], aov[kAovNormal + 2]);
  const float scale = camera.cameraIsOrthographic != 0 ? 1 : depth;
  const float pixel = 2 * glm::length(camera.cameraRight) * scale / static_cast<float>(camera.imageSize.x);
  const float seenDepth = glm::dot(seen - camera.cameraOrigin, camera.cameraForward);
  return std::abs(glm::dot(point.position - seen, normal)) < 2 * pixel && std::abs(depth - seenDepth) < 0.2f * depth;
}

}  // namespace

std::vector<float> countPoints(std::span<const MapPoint> points, float weight, const Parameters& camera,
                               std::span<const float> aovs) {
  std::vector<float> counts(aovs.size() / kAovFloats);
  for (const MapPoint& point : points) {
    float depth = 0;
    const auto pixel = pixelOf(point.position, camera, depth);
    if (pixel && isOnSeenSurface(point, aovs.subspan(*pixel * kAovFloats, kAovFloats), depth, camera))
      counts[*pixel] += weight;
  }
  return counts;
}

}  // namespace importon
