#include "render/features/feature_set.h"

#include <algorithm>
#include <array>

#include "render/options/gather_source.h"
#include "scene/images/texture_sampling.h"
#include "scene/materials/material_table.h"
#include "shared/features.h"

namespace importon {
namespace {

/// Roughness below which lib/bsdf.glsl makes a lobe a delta: alpha = roughness² < kSmoothAlpha.
constexpr float kSmoothRoughness = 0.0317f;

bool reflects(const Material& m) {
  return m.metallic > 0 || m.specular > 0 || m.transmission > 0 || m.clearcoat > 0 ||
         m.metallicRoughnessTexture != kNone || m.diffuseTransmission > 0 || material_table::hasSheen(m) ||
         m.iridescence > 0;
}

/// Least value of the roughness channel (green) of a texture.
float leastRoughness(const Scene& scene, uint texture) {
  if (texture == kNone) return 1;
  const Texture& t = scene.textures[texture];
  float least = 1;
  for (std::size_t i = 0; i < std::size_t{t.width} * t.height; ++i)
    least = std::min(least, texelAt(t, scene.texels, i).y);
  return least;
}

bool mayBeSmooth(const Scene& scene, const Material& m) {
  if (m.clearcoat > 0 && m.clearcoatRoughness * leastRoughness(scene, m.clearcoatRoughnessTexture) < kSmoothRoughness)
    return true;
  return reflects(m) && m.roughness * leastRoughness(scene, m.metallicRoughnessTexture) < kSmoothRoughness;
}

bool usesTextures(const Material& m) {
  bool uses = false;
  visitTextures(m, [&](uint texture) { uses = uses || texture != kNone; });
  return uses;
}

bool isTinted(const Vertex& v) {
  constexpr uint kWhiteHalves = 0x3C003C00u;
  return v.colorRG != kWhiteHalves || (v.colorBA & 0xFFFFu) != 0x3C00u;
}

/// COLOR_0 shows where it is not white, and where its alpha counts and is not 1.
bool hasAnyColor(const Scene& scene) {
  constexpr uint kOpaque = 0x3C00u;
  const auto isThinned = [&](const Triangle& t) {
    if ((scene.materials[t.material].flags & (kMaterialAlphaMask | kMaterialAlphaBlend)) == 0) return false;
    return std::ranges::any_of(std::array{t.v0, t.v1, t.v2},
                               [&](uint v) { return scene.vertices[v].colorBA >> 16 != kOpaque; });
  };
  return std::ranges::any_of(scene.vertices, isTinted) || std::ranges::any_of(scene.triangles, isThinned);
}

bool anyMaterial(const Scene& scene, bool (*test)(const Material&)) {
  return std::any_of(scene.materials.begin(), scene.materials.end(), test);
}

bool anyLight(const Scene& scene, bool (*test)(uint kind)) {
  return std::any_of(scene.lights.begin(), scene.lights.end(), [&](const Light& light) { return test(light.kind); });
}

bool emitsThroughAlpha(const Material& m) {
  return (m.flags & kMaterialEmissive) != 0 && (m.flags & (kMaterialAlphaMask | kMaterialAlphaBlend)) != 0;
}

bool transmits(const Material& m) { return m.transmission > 0 || m.diffuseTransmission > 0; }

bool absorbs(const Material& m) {
  return (m.flags & kMaterialSolid) != 0 && transmits(m) && glm::any(glm::greaterThan(m.absorption, vec3(0)));
}

/// An open surface with a volume.
bool isAbsorbingSheet(const Material& m) {
  const bool absorbs = glm::any(glm::greaterThan(m.absorption, vec3(0)));
  return (m.flags & kMaterialSolid) == 0 && m.thickness > 0 && transmits(m) && absorbs;
}

bool disperses(const Material& m) { return (m.flags & kMaterialSolid) != 0 && m.transmission > 0 && m.dispersion > 0; }

bool needsCaustics(const Scene& scene, const RenderJob& job) {
  return job.forcesAllFeatures || std::any_of(scene.materials.begin(), scene.materials.end(), [&](const Material& m) {
           return mayBeSmooth(scene, m) || m.transmission > 0;
         });
}

/// Of a scene: what is modelled if anything there asks for it, or the job forces all. Of maps: never by path tracing.
enum class FeatureKind { scene, maps };

struct FeatureEntry {
  const char* name;
  bool FeatureSet::*flag;
  uint specialization;  // its constant in kernels; kNone: none
  FeatureKind kind;
  bool (*isNeeded)(const Scene&, const RenderJob&);
  const char *with, *without;  // why
};

using S = const Scene&;
using J = const RenderJob&;
using M = const Material&;
using F = FeatureSet;
constexpr auto kScene = FeatureKind::scene;
constexpr auto kMaps = FeatureKind::maps;

const std::array kFeatures{
    FeatureEntry{"alpha", &F::hasAlpha, kNone, kScene,
                 [](S scene, J) {
                   return anyMaterial(scene,
                                      [](M m) { return (m.flags & (kMaterialAlphaMask | kMaterialAlphaBlend)) != 0; });
                 },
                 "a material is masked or blended", "every material is opaque"},
    FeatureEntry{"textures", &F::hasTextures, kSpecHasTextures, kScene,
                 [](S scene, J) { return anyMaterial(scene, usesTextures); }, "a material uses a texture",
                 "no material uses a texture"},
    FeatureEntry{"deep textures", &F::hasDeepTextures, kSpecHasDeepTextures, kScene,
                 [](S scene, J) {
                   return std::any_of(scene.textures.begin(), scene.textures.end(),
                                      [](const Texture& t) { return t.isDeep != 0; });
                 },
                 "a texture has 16 bits a channel", "textures have 8 bits a channel"},
    FeatureEntry{"normal maps", &F::hasNormalMaps, kSpecHasNormalMaps, kScene,
                 [](S scene, J) {
                   return anyMaterial(
                       scene, [](M m) { return m.normalTexture != kNone || m.clearcoatNormalTexture != kNone; });
                 },
                 "a material has a normal texture", "no material has a normal texture"},
    FeatureEntry{"vertex colours", &F::hasVertexColors, kSpecHasVertexColors, kScene,
                 [](S scene, J) { return hasAnyColor(scene); }, "a mesh has COLOR_0",
                 "no mesh has a colour other than white"},
    FeatureEntry{"reflection", &F::hasReflection, kSpecHasReflection, kScene,
                 [](S scene, J) { return anyMaterial(scene, reflects); },
                 "a material reflects otherwise than Lambert's law", "every material is Lambertian"},
    FeatureEntry{"transmission", &F::hasTransmission, kSpecHasTransmission, kScene,
                 [](S scene, J) { return anyMaterial(scene, transmits); }, "a material transmits light",
                 "no material transmits light"},
    FeatureEntry{"media", &F::hasMedia, kSpecHasMedia, kScene, [](S scene, J) { return anyMaterial(scene, absorbs); },
                 "a solid absorbs light", "no solid absorbs light"},
    FeatureEntry{"clear coat", &F::hasClearcoat, kSpecHasClearcoat, kScene,
                 [](S scene, J) { return anyMaterial(scene, [](M m) { return m.clearcoat > 0; }); },
                 "a material has a clear coat", "no material has a clear coat"},
    FeatureEntry{"diffuse transmission", &F::hasDiffuseTransmission, kSpecHasDiffuseTransmission, kScene,
                 [](S scene, J) { return anyMaterial(scene, material_table::transmitsDiffusely); },
                 "a material transmits light diffusely", "no material transmits light diffusely"},
    FeatureEntry{"sheen", &F::hasSheen, kSpecHasSheen, kScene,
                 [](S scene, J) { return anyMaterial(scene, material_table::hasSheen); }, "a material has a sheen",
                 "no material has a sheen"},
    FeatureEntry{"anisotropy", &F::hasAnisotropy, kSpecHasAnisotropy, kScene,
                 [](S scene, J) { return anyMaterial(scene, material_table::isAnisotropic); },
                 "a material is rougher along its tangent", "every material is as rough in all directions"},
    FeatureEntry{"iridescence", &F::hasIridescence, kSpecHasIridescence, kScene,
                 [](S scene, J) { return anyMaterial(scene, material_table::isIridescent); },
                 "a thin film covers a material", "no thin film covers a material"},
    FeatureEntry{"dispersion", &F::hasDispersion, kSpecHasDispersion, kScene,
                 [](S scene, J) { return anyMaterial(scene, disperses); }, "a solid bends colours differently",
                 "no solid bends colours differently"},
    FeatureEntry{"thickness textures", &F::hasThicknessTextures, kSpecHasThicknessTextures, kScene,
                 [](S scene, J) { return anyMaterial(scene, [](M m) { return m.thicknessTexture != kNone; }); },
                 "a volume has a thickness texture", "no volume has a thickness texture"},
    FeatureEntry{"sheets", &F::hasSheets, kSpecHasSheets, kScene,
                 [](S scene, J) { return anyMaterial(scene, isAbsorbingSheet); },
                 "an open surface absorbs by its thickness", "no open surface absorbs by its thickness"},
    FeatureEntry{"panes", &F::hasPanes, kSpecHasPanes, kScene,
                 [](S scene, J) { return anyMaterial(scene, material_table::isPane); },
                 "a smooth thin surface lets light go straight on", "no smooth thin surface lets light go straight on"},
    FeatureEntry{"placed meshes", &F::hasInstances, kSpecHasInstances, kScene,
                 [](S scene, J) { return !scene.placed.isEmpty(); }, "meshes stand in many places, and are held once",
                 "every mesh stands flattened in the world"},
    FeatureEntry{"area lights", &F::hasTriangleLights, kSpecHasTriangleLights, kScene,
                 [](S scene, J) { return anyLight(scene, [](uint kind) { return kind == kLightTriangle; }); },
                 "a triangle emits", "no triangle emits"},
    FeatureEntry{"cut-out lights", &F::hasCutLights, kSpecHasCutLights, kScene,
                 [](S scene, J) { return anyMaterial(scene, emitsThroughAlpha); },
                 "a material that emits is masked or blended", "no material that emits is masked or blended"},
    FeatureEntry{"punctual lights", &F::hasPunctualLights, kSpecHasPunctualLights, kScene,
                 [](S scene, J) {
                   return anyLight(scene,
                                   [](uint kind) { return kind != kLightTriangle && kind != kLightEnvironment; });
                 },
                 "there is a point, spot, profile or directional light", "there is no punctual light"},
    FeatureEntry{"light profiles", &F::hasLightProfiles, kSpecHasLightProfiles, kScene,
                 [](S scene, J) { return anyLight(scene, [](uint kind) { return kind == kLightProfile; }); },
                 "a light has a photometric profile", "no light has a photometric profile"},
    FeatureEntry{"environment", &F::hasEnvironment, kSpecHasEnvironment, kScene,
                 [](S scene, J) { return anyLight(scene, [](uint kind) { return kind == kLightEnvironment; }); },
                 "the scene has an environment", "the scene has no environment"},
    FeatureEntry{"caustic map", &F::needsCausticMap, kSpecHasCausticMap, kMaps, needsCaustics,
                 "a surface may be smooth enough to focus light", "no surface is specular"},
    FeatureEntry{"surface cells", &F::readsCells, kSpecReadsCells, kMaps,
                 [](S, J job) { return gatherSource(job) == GatherSource::cells; },
                 "gather rays read the irradiance of surface cells", "gather rays read photons"},
    FeatureEntry{"global map", &F::needsGlobalMap, kSpecHasGlobalMap, kMaps, [](S, J) { return true; },
                 "light comes back from surfaces that are no lights", ""}};

}  // namespace

FeatureSet findFeatures(const Scene& scene, const RenderJob& job) {
  FeatureSet features;
  features.pixelFilter = static_cast<uint>(job.filter);
  features.hasBackground = job.isTransparent || job.background.has_value();
  for (const FeatureEntry& entry : kFeatures) {
    const bool isOut = entry.kind == FeatureKind::maps && job.integrator == Integrator::path;
    const bool isForced = entry.kind == FeatureKind::scene && job.forcesAllFeatures;
    features.*entry.flag = !isOut && (isForced || entry.isNeeded(scene, job));
  }
  return features;
}

std::vector<gpu::Specialization> specializations(const FeatureSet& features) {
  std::vector<gpu::Specialization> constants{{kSpecPixelFilter, features.pixelFilter},
                                             {kSpecHasBackground, features.hasBackground}};
  for (const FeatureEntry& entry : kFeatures)
    if (entry.specialization != kNone) constants.push_back({entry.specialization, features.*entry.flag});
  return constants;
}

std::vector<FeatureRow> describeFeatures(const Scene& scene, const RenderJob& job) {
  const FeatureSet features = findFeatures(scene, job);
  std::vector<FeatureRow> rows;
  for (const FeatureEntry& entry : kFeatures) {
    const bool isModelled = features.*entry.flag;
    const bool isOut = entry.kind == FeatureKind::maps && job.integrator == Integrator::path;
    rows.push_back({entry.name, isModelled,
                    isModelled ? entry.with
                    : isOut    ? "the path tracer reads no map"
                               : entry.without});
  }
  return rows;
}

}  // namespace importon
