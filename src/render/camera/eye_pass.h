/// Paths from the camera that make the image.
#pragma once
#include "render/photon_map/photon_map.h"

namespace importon {

/// What camera paths read; a photon map is null where there is none. Importance is bound also where nothing reads it.
struct EyeMaps {
  const ImportanceMap *causticImportance = nullptr, *globalImportance = nullptr;
  const PhotonMap* caustic = nullptr;
  const PhotonMap* global = nullptr;
  bool hasCells = false;  // gather rays read the irradiance map that is bound

  void see(MapKind kind, const PhotonMap& map) { (kind == MapKind::global ? global : caustic) = &map; }
};

/// Which paths of a pass: so many of each pixel; or, with a plan (render/film/adaptive_sampler.h), so many of all that
/// it deals.
struct EyeSamples {
  uint first = 0, count = 1;
  const gpu::Buffer* plan = nullptr;
};

/// Paths for the pixels `first` .. `first + count`; adds what they bring to `film` from FilmPixel `filmOffset`
/// on. The workspace must have slots for all of them.
void traceImage(const Stage& stage, const EyeMaps& maps, const EyeSamples& samples, uint first, uint count,
                uint maxDepth, const gpu::Buffer& film, uint filmOffset);

/// Rays through the middle of the pixels, and the AOV buffer (kAovFloats per pixel) from what they hit.
void traceAovs(const Stage& stage, const EyeMaps& maps, uint first, uint count, const gpu::Buffer& aov);

}  // namespace importon
