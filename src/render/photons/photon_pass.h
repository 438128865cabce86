/// Photons from the lights, in batches.
#pragma once
#include "render/guiding/emission_guide.h"
#include "render/guiding/scatter_guide.h"

namespace importon {

/// Which photons: for the global map (all paths) or for the caustic map (light, specular events, first other one).
struct PhotonSource {
  MapKind kind = MapKind::global;
  const EmissionGuide* guide = nullptr;   // null: emission by power
  bool isPilot = false;                   // with random numbers that no photon of a map has
  const ScatterGuide* scatter = nullptr;  // null: by the material alone; else of the global map
};

/// Emits and traces photons `first` .. `first + count` of the pass; their hits are left in the workspace's records.
void tracePhotons(const Stage& stage, const PhotonSource& source, std::uint32_t first, std::uint32_t count,
                  uint maxDepth);

/// Traces importance from the sites of the global map as if it were photons; what it meets is left in the records, and
/// trains `guide`.
void trainScatterGuide(const Stage& stage, const ImportanceMap& importance, ScatterGuide& guide,
                       const ScatterBatch& batch);

/// Traces importance from the sites of a map as if it were photons of `kind`; `guide` notes where it leaves the scene.
void noteEscapes(const Stage& stage, MapKind kind, const ImportanceMap& importance, const EnvironmentGuide& guide,
                 const ScatterBatch& batch);

}  // namespace importon
