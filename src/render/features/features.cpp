#include "render/features/features.h"

#include "render/features/feature_set.h"

namespace importon {

std::vector<FeatureRow> describeFeatures(const Scene& scene, const RenderJob& job) {
  const FeatureSet f = findFeatures(scene, job);
  const auto row = [&](const char* name, bool isModelled, const char* with, const char* without) {
    return FeatureRow{name, isModelled, isModelled ? with : without};
  };
  return {
      row("alpha", f.hasAlpha, "a material is masked or blended", "every material is opaque"),
      row("textures", f.hasTextures, "a material uses a texture", "no material uses a texture"),
      row("normal maps", f.hasNormalMaps, "a material has a normal texture", "no material has a normal texture"),
      row("vertex colours", f.hasVertexColors, "a mesh has COLOR_0", "no mesh has a colour other than white"),
      row("reflection", f.hasReflection, "a material reflects otherwise than Lambert's law",
          "every material is Lambertian"),
      row("transmission", f.hasTransmission, "a material transmits light", "no material transmits light"),
      row("media", f.hasMedia, "a solid absorbs light", "no solid absorbs light"),
      row("clear coat", f.hasClearcoat, "a material has a clear coat", "no material has a clear coat"),
      row("area lights", f.hasTriangleLights, "a triangle emits", "no triangle emits"),
      row("punctual lights", f.hasPunctualLights, "there is a point, spot or directional light",
          "there is no punctual light"),
      row("environment", f.hasEnvironment, "the scene has an environment", "the scene has no environment"),
      row("caustic map", f.needsCausticMap, "a surface may be smooth enough to focus light",
          job.integrator == Integrator::path ? "the path tracer reads no map" : "no surface is specular"),
      row("surface cells", f.readsCells, "gather rays read the irradiance of surface cells",
          job.integrator == Integrator::path ? "the path tracer reads no map" : "gather rays read photons"),
      row("global map", f.needsGlobalMap, "light comes back from surfaces that are no lights",
          "the path tracer reads no map"),
  };
}

}  // namespace importon
