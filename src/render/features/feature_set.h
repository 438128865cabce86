/// Which code and which passes a scene needs. Becomes specialization constants of the kernels.
#pragma once
#include <string>
#include <vector>

#include "gpu/kernel.h"
#include "render/map_kind.h"
#include "render/render_job.h"
#include "scene/scene.h"

namespace importon {

/// What each is for stands in the table of feature_set.cpp.
struct FeatureSet {
  bool hasAlpha = false, hasTextures = false, hasNormalMaps = false, hasVertexColors = false, hasReflection = false,
       hasTransmission = false, hasMedia = false, hasClearcoat = false, hasDiffuseTransmission = false,
       hasSheen = false, hasAnisotropy = false, hasIridescence = false, hasDispersion = false,
       hasThicknessTextures = false, hasTriangleLights = false, hasCutLights = false, hasPunctualLights = false,
       hasEnvironment = false, hasDeepTextures = false, hasSheets = false, hasLightProfiles = false,
       hasInstances = false, hasPanes = false;
  bool needsCausticMap = false, readsCells = false, needsGlobalMap = false;
  uint pixelFilter = 0;        // kFilter*
  bool hasBackground = false;  // the camera sees another background than the environment

  /// Photons of a kind are shot: into a map, or into surface cells.
  [[nodiscard]] bool needsPhotons(MapKind kind) const { return kind == MapKind::global || needsCausticMap; }
  [[nodiscard]] bool needsPhotonMap(MapKind kind) const {
    return kind == MapKind::global ? !readsCells : needsCausticMap;
  }
};

/// What `scene` needs for `job`; everything if the job forces all features.
[[nodiscard]] FeatureSet findFeatures(const Scene& scene, const RenderJob& job);

/// The features as specialization constants (shaders/shared/features.h).
[[nodiscard]] std::vector<gpu::Specialization> specializations(const FeatureSet& features);

struct FeatureRow {
  std::string name;
  bool isModelled = false;
  std::string why;
};

/// Every feature of the renderer, modelled or left out, in a fixed order.
[[nodiscard]] std::vector<FeatureRow> describeFeatures(const Scene& scene, const RenderJob& job);

}  // namespace importon
