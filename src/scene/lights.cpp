#include "scene/lights.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/packing.hpp>
#include <optional>

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

/// A material's texture on a triangle; nullopt: it has none.
std::optional<TriangleTexture> textureOn(const Scene& scene, const Triangle& triangle, uint index) {
  if (index == kNone) return std::nullopt;
  const Texture& texture = scene.textures[index];
  const auto uvOf = [&](uint vertex) {
    return texture.uvSet == 0 ? scene.vertices[vertex].uv0 : scene.vertices[vertex].uv1;
  };
  const vec2 uv[3] = {uvOf(triangle.v0), uvOf(triangle.v1), uvOf(triangle.v2)};
  return TriangleTexture(texture, scene.texels, uv);
}

/// What alpha leaves of a triangle, as coverageAt of shaders/lib/alpha.glsl does.
class Coverage {
 public:
  Coverage(const Scene& scene, const Triangle& triangle, const Material& material)
      : material_(material), texture_(textureOn(scene, triangle, material.baseColorTexture)) {
    for (int k = 0; k < 3; ++k) {
      const uint vertex = k == 0 ? triangle.v0 : k == 1 ? triangle.v1 : triangle.v2;
      cornerAlpha_[k] = glm::unpackHalf2x16(scene.vertices[vertex].colorBA).y;
    }
  }
  [[nodiscard]] bool isWhole() const { return (material_.flags & (kMaterialAlphaMask | kMaterialAlphaBlend)) == 0; }
  [[nodiscard]] int samplesPerSide() const {
    constexpr int kLeast = 16;  // an edge of a mask is as sharp as can be, whatever the texels
    return isWhole() ? 1 : std::max(kLeast, texture_ ? texture_->samplesPerSide() : 1);
  }
  [[nodiscard]] float at(float u, float v) const {
    if (isWhole()) return 1.0f;
    float alpha = material_.baseColor.w * glm::dot(cornerAlpha_, vec3(1.0f - u - v, u, v));
    if (texture_) alpha *= texture_->at(u, v).w;
    if ((material_.flags & kMaterialAlphaMask) != 0) return alpha >= material_.alphaCutoff ? 1.0f : 0.0f;
    return std::clamp(alpha, 0.0f, 1.0f);
  }

 private:
  const Material& material_;
  std::optional<TriangleTexture> texture_;
  vec3 cornerAlpha_{1.0f};
};

/// W/(m² sr), the mean over the triangle of what alpha leaves of it.
vec3 meanRadiance(const Scene& scene, const Triangle& triangle, const Material& material) {
  const std::optional<TriangleTexture> emission = textureOn(scene, triangle, material.emissiveTexture);
  const Coverage coverage(scene, triangle, material);
  if (!emission && coverage.isWhole()) return material.emission;
  const auto meanOf = [&](int side) {
    return material.emission * vec3(meanOverTriangle(side, [&](float u, float v) {
             return (emission ? vec3(emission->at(u, v)) : vec3(1.0f)) * coverage.at(u, v);
           }));
  };
  constexpr int kFiner = 4;  // a light of no power is none: then little must have been missed
  const int side = std::max(emission ? emission->samplesPerSide() : 1, coverage.samplesPerSide());
  const vec3 mean = meanOf(side);
  return mean == vec3(0.0f) && !coverage.isWhole() ? meanOf(kFiner * side) : mean;
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

float profilePower(const vec3& intensity, double shareIntegral) {
  return boundedPower(meanOf(intensity) * shareIntegral);
}

float directionalPower(const vec3& irradiance, float sceneRadius) {
  return boundedPower(meanOf(irradiance) * kPi * sceneRadius * sceneRadius);
}

float environmentPower(const vec3& radiance, float sceneRadius) {
  return boundedPower(4.0 * kPi * meanOf(radiance) * kPi * sceneRadius * sceneRadius);
}

void addEmissiveTriangles(Scene& scene) {
  constexpr std::size_t kLightsPerTask = 256;
  std::vector<std::size_t> emitters;
  for (std::size_t i = 0; i < scene.worldTriangleCount(); ++i) {
    if ((scene.materials[scene.triangles[i].material].flags & kMaterialEmissive) != 0) emitters.push_back(i);
  }
  std::vector<Light> lights(emitters.size());
  parallelFor(emitters.size(), kLightsPerTask, 0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) lights[i] = triangleLight(scene, emitters[i]);
  });
  for (const Light& light : lights) {
    if (!(light.power > 0)) continue;
    if (scene.lightOfTriangle.empty()) scene.lightOfTriangle.assign(scene.worldTriangleCount(), kNone);
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
