#include "render/features/feature_set.h"

#include <algorithm>

#include "render/options/gather_source.h"
#include "shared/features.h"

namespace importon {
namespace {

/// Roughness below which lib/bsdf.glsl makes a lobe a delta: alpha = roughness² < kSmoothAlpha.
constexpr float kSmoothRoughness = 0.0317f;

bool reflects(const Material& m) {
  return m.metallic > 0 || m.specular > 0 || m.transmission > 0 || m.clearcoat > 0 ||
         m.metallicRoughnessTexture != kNone;
}

/// Least value of the roughness channel (green) of a texture.
float leastRoughness(const Scene& scene, uint texture) {
  if (texture == kNone) return 1;
  const Texture& t = scene.textures[texture];
  uint least = 255;
  for (std::size_t i = 0; i < std::size_t{t.width} * t.height; ++i)
    least = std::min(least, (scene.texels[t.firstTexel + i] >> 8) & 255u);
  return static_cast<float>(least) / 255.0f;
}

bool mayBeSmooth(const Scene& scene, const Material& m) {
  if (m.clearcoat > 0 && m.clearcoatRoughness * leastRoughness(scene, m.clearcoatRoughnessTexture) < kSmoothRoughness)
    return true;
  return reflects(m) && m.roughness * leastRoughness(scene, m.metallicRoughnessTexture) < kSmoothRoughness;
}

bool usesTextures(const Material& m) {
  const uint slots[] = {m.baseColorTexture,      m.metallicRoughnessTexture, m.normalTexture,
                        m.emissiveTexture,       m.transmissionTexture,      m.specularTexture,
                        m.specularColorTexture,  m.clearcoatTexture,         m.clearcoatRoughnessTexture,
                        m.clearcoatNormalTexture};
  return std::any_of(std::begin(slots), std::end(slots), [](uint slot) { return slot != kNone; });
}

bool hasAnyColor(const Scene& scene) {
  constexpr uint kWhiteHalves = 0x3C003C00u;
  return std::any_of(scene.vertices.begin(), scene.vertices.end(),
                     [](const Vertex& v) { return v.colorRG != kWhiteHalves || (v.colorBA & 0xFFFFu) != 0x3C00u; });
}

}  // namespace

FeatureSet findFeatures(const Scene& scene, const RenderJob& job) {
  FeatureSet f;
  for (const Material& m : scene.materials) {
    f.hasAlpha = f.hasAlpha || (m.flags & (kMaterialAlphaMask | kMaterialAlphaBlend)) != 0;
    f.hasTextures = f.hasTextures || usesTextures(m);
    f.hasNormalMaps = f.hasNormalMaps || m.normalTexture != kNone || m.clearcoatNormalTexture != kNone;
    f.hasReflection = f.hasReflection || reflects(m);
    f.hasTransmission = f.hasTransmission || m.transmission > 0;
    f.hasMedia = f.hasMedia || ((m.flags & kMaterialSolid) != 0 && m.transmission > 0 &&
                                glm::any(glm::greaterThan(m.absorption, vec3(0))));
    f.hasClearcoat = f.hasClearcoat || m.clearcoat > 0;
    f.needsCausticMap = f.needsCausticMap || mayBeSmooth(scene, m) || m.transmission > 0;
  }
  for (const Light& light : scene.lights) {
    f.hasTriangleLights = f.hasTriangleLights || light.kind == kLightTriangle;
    f.hasEnvironment = f.hasEnvironment || light.kind == kLightEnvironment;
    f.hasPunctualLights = f.hasPunctualLights || (light.kind != kLightTriangle && light.kind != kLightEnvironment);
  }
  f.hasVertexColors = hasAnyColor(scene);
  f.needsGlobalMap = true;
  if (job.forcesAllFeatures) {
    f = {true, true, true, true, true, true, true, true, true, true, true, 0, true, false, true};
  }
  f.readsCells = gatherSource(job) == GatherSource::cells;
  f.pixelFilter = static_cast<uint>(job.filter);
  if (job.integrator == Integrator::path) f.needsCausticMap = f.needsGlobalMap = f.readsCells = false;
  return f;
}

std::vector<gpu::Specialization> specializations(const FeatureSet& f) {
  return {{kSpecHasTextures, f.hasTextures},
          {kSpecHasNormalMaps, f.hasNormalMaps},
          {kSpecHasVertexColors, f.hasVertexColors},
          {kSpecHasReflection, f.hasReflection},
          {kSpecHasTransmission, f.hasTransmission},
          {kSpecHasMedia, f.hasMedia},
          {kSpecHasClearcoat, f.hasClearcoat},
          {kSpecHasTriangleLights, f.hasTriangleLights},
          {kSpecHasPunctualLights, f.hasPunctualLights},
          {kSpecHasEnvironment, f.hasEnvironment},
          {kSpecPixelFilter, f.pixelFilter},
          {kSpecHasCausticMap, f.needsCausticMap},
          {kSpecHasGlobalMap, f.needsGlobalMap},
          {kSpecReadsCells, f.readsCells}};
}

}  // namespace importon
