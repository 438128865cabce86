#include "scene/lights.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "base/parallel.h"
#include "scene/environment.h"
#include "scene/images/texture_sampling.h"
#include "scene/light_math.h"

namespace importon {
namespace {

/// Sums of powers must stay finite.
float boundedPower(double watts) { return static_cast<float>(std::min(watts, 1e30)); }

float triangleArea(const Scene& scene, const Triangle& triangle) {
  const glm::dvec3 a(scene.positions[triangle.v0]);
  const glm::dvec3 e1 = glm::dvec3(scene.positions[triangle.v1]) - a;
  const glm::dvec3 e2 = glm::dvec3(scene.positions[triangle.v2]) - a;
  return static_cast<float>(0.5 * glm::length(glm::cross(e1, e2)));
}

vec3 meanRadiance(const Scene& scene, const Triangle& triangle, const Material& material) {
  if (material.emissiveTexture == kNone) return material.emission;
  const Texture& texture = scene.textures[material.emissiveTexture];
  const auto uvOf = [&](uint vertex) {
    return texture.uvSet == 0 ? scene.vertices[vertex].uv0 : scene.vertices[vertex].uv1;
  };
  const vec2 uv[3] = {uvOf(triangle.v0), uvOf(triangle.v1), uvOf(triangle.v2)};
  return material.emission * meanOverTriangle(texture, scene.texels, uv);
}

Light triangleLight(const Scene& scene, std::size_t index) {
  const Triangle& triangle = scene.triangles[index];
  const Material& material = scene.materials[triangle.material];
  Light light{};
  light.kind = kLightTriangle;
  light.triangle = static_cast<uint>(index);
  light.area = triangleArea(scene, triangle);
  light.emission = meanRadiance(scene, triangle, material);
  light.power = trianglePower(light.area, light.emission, (material.flags & kMaterialDoubleSided) != 0);
  return light;
}

}  // namespace

BoundingSphere boundingSphere(const Scene& scene) {
  const vec3 halfDiagonal = (scene.boundsMax - scene.boundsMin) * 0.5f;
  return {scene.boundsMin + halfDiagonal, glm::length(halfDiagonal)};
}

float trianglePower(float area, const vec3& radiance, bool isDoubleSided) {
  return boundedPower(kPi * area * meanOf(radiance) * (isDoubleSided ? 2.0 : 1.0));
}

float pointPower(const vec3& intensity) { return boundedPower(4.0 * kPi * meanOf(intensity)); }

float spotPower(const vec3& intensity, float cosInner, float cosOuter) {
  const double inner = cosInner;
  return boundedPower(2.0 * kPi * meanOf(intensity) * ((1.0 - inner) + (inner - cosOuter) / 3.0));
}

float directionalPower(const vec3& irradiance, float sceneRadius) {
  return boundedPower(meanOf(irradiance) * kPi * sceneRadius * sceneRadius);
}

float environmentPower(const vec3& radiance, float sceneRadius) {
  return boundedPower(4.0 * kPi * meanOf(radiance) * kPi * sceneRadius * sceneRadius);
}

void addEmissiveTriangles(Scene& scene) {
  constexpr std::size_t kGrain = 256;
  std::vector<std::size_t> emitters;
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    if ((scene.materials[scene.triangles[i].material].flags & kMaterialEmissive) != 0) emitters.push_back(i);
  }
  std::vector<Light> lights(emitters.size());
  parallelFor(emitters.size(), kGrain, 0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) lights[i] = triangleLight(scene, emitters[i]);
  });
  for (const Light& light : lights) {
    if (!(light.power > 0)) continue;
    if (scene.lightOfTriangle.empty()) scene.lightOfTriangle.assign(scene.triangles.size(), kNone);
    scene.lightOfTriangle[light.triangle] = static_cast<uint>(scene.lights.size());
    scene.lights.push_back(light);
  }
}

void addEnvironmentLight(Scene& scene) {
  if (!scene.environment) return;
  const vec3 mean = meanRadiance(*scene.environment);
  if (!(meanOf(mean) > 0)) return;
  Light light{};
  light.kind = kLightEnvironment;
  light.triangle = kNone;
  light.emission = mean;
  light.power = environmentPower(light.emission, boundingSphere(scene).radius);
  scene.lights.push_back(light);
}

}  // namespace importon
