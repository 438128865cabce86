/// Which code and which passes a scene needs. Becomes specialization constants of the kernels.
#pragma once
#include <vector>

#include "gpu/kernel.h"
#include "render/map_kind.h"
#include "render/render_job.h"
#include "scene/scene.h"

namespace importon {

struct FeatureSet {
  bool hasAlpha = false;
  bool hasTextures = false;
  bool hasNormalMaps = false;
  bool hasVertexColors = false;
  bool hasReflection = false;  // anything but Lambertian reflection
  bool hasTransmission = false;
  bool hasMedia = false;  // absorbing solids
  bool hasClearcoat = false;
  bool hasTriangleLights = false;
  bool hasPunctualLights = false;
  bool hasEnvironment = false;
  uint pixelFilter = 0;          // kFilter*
  bool needsCausticMap = false;  // a smooth reflecting or transmitting surface
  bool readsCells = false;       // gather rays read surface cells, not photons
  bool needsGlobalMap = false;   // light that comes from a surface that is no light

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

}  // namespace importon
