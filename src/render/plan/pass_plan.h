/// The numbers of a render that the job leaves open, and those that follow from the scene.
#pragma once
#include "gpu/context.h"
#include "render/features/feature_set.h"
#include "render/map_kind.h"
#include "render/plan/camera_setup.h"
#include "render/plan/storage_rule.h"

namespace importon {

inline constexpr int kPartsOfPass = 4;

/// What a pass does: the whole of what is planned, or a part of it.
struct PassSize {
  std::uint32_t samples = 1;  // camera paths per pixel
  std::uint32_t photons = 0, causticPhotons = 0;

  [[nodiscard]] std::uint32_t photonsFor(MapKind kind) const {
    return kind == MapKind::global ? photons : causticPhotons;
  }
  [[nodiscard]] std::uint32_t& photonsFor(MapKind kind) { return kind == MapKind::global ? photons : causticPhotons; }
};

/// How much a pass may hold at once, at most. Room for records and entries is made as they come.
struct WorkspaceSize {
  std::uint64_t slots = 0;        // paths in flight
  std::uint64_t records = 0;      // hits of a photon batch, or importons
  std::uint64_t entries = 0;      // the longest list that is sorted
  bool hasCells = false;          // records know the surface cell that they fell in
  bool hasDifferentials = false;  // of importons
  std::uint64_t lightVoxels = 1;  // that remember which lights reach them
};

struct PassPlan {
  PassSize whole;           // of the largest passes
  std::uint32_t batch = 0;  // traced at once
  std::uint32_t importons = 0;
  std::uint32_t samplesAtOnce = 1;  // of a pixel
  bool isAdaptive = false;          // pixels have more or fewer than `samples`: render/film/adaptive_sampler.h
  uint nearestImportons = 32;       // M of the importance estimate
  StorageRule storage;              // without control and expected density, which may change
  uint nearestPhotons = 0;          // of a lookup; 0: all within a radius
  std::uint64_t tilePixels = 0;
  std::uint64_t mapCapacity = 0;  // photons, of the global map
  std::uint64_t causticCapacity = 0;
  std::uint64_t mostCells = 0;  // of the irradiance map
  int maxPasses = 64;
  WorkspaceSize workspace;

  /// A pass of 1 to kPartsOfPass of as many parts.
  [[nodiscard]] PassSize sizeOf(int parts) const;
  [[nodiscard]] std::uint64_t capacityFor(MapKind kind) const {
    return kind == MapKind::global ? mapCapacity : causticCapacity;
  }
};

/// Chooses counts for a film of `size` pixels on a device of `limits`.
[[nodiscard]] PassPlan planPasses(const RenderJob& job, const FeatureSet& features, glm::ivec2 size,
                                  const gpu::Limits& limits);

/// m², of one side of all triangles; of placed meshes with several scales nearly.
[[nodiscard]] double surfaceArea(const Scene& scene);

/// Parameters that hold for all passes: camera, scene, map settings.
[[nodiscard]] Parameters makeParameters(const RenderJob& job, const Scene& scene, const PassPlan& plan,
                                        const FilmPlace& film);

}  // namespace importon
