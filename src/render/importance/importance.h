/// Importance maps: importons, and importance at each from its nearest ones.
#pragma once
#include <vector>

#include "render/lists/point_grid.h"
#include "render/map_kind.h"

namespace importon {

/// An importance map as kernels read it.
struct ImportanceBuffers {
  const gpu::Buffer &importonCells, &importonPoints, &importances, &importanceBounds, &importonHits;
};

/// One of every kImportonsPerSite importons in cells, with importance Γ (pixels/m²) from all of them at each.
struct ImportanceMap {
  PointGrid grid;
  gpu::Buffer importance;   // float per site, in cell order
  gpu::Buffer bound;        // the same by path differentials; empty: without
  gpu::Buffer hits;         // uint per site: photon hits near it in all passes so far
  uint levels = 0;          // grid levels in use, a bit each
  std::uint64_t count = 0;  // importons

  [[nodiscard]] ImportanceBuffers buffers() const;
  /// The sites, render space; each stands for kImportonsPerSite importons.
  [[nodiscard]] std::vector<MapPoint> readPoints() const;
  [[nodiscard]] std::uint64_t sites() const { return (count + kImportonsPerSite - 1) / kImportonsPerSite; }
};

/// An empty map for up to `importons` importons.
[[nodiscard]] ImportanceMap makeImportanceMap(gpu::Context& context, MapKind kind, std::uint64_t importons,
                                              bool hasDifferentials);

/// How importance is found.
struct ImportanceJob {
  std::uint32_t importons = 0;
  uint nearest = 0;              // M of the talk: importons of an estimate
  bool needsCausticMap = false;  // else its importons are only counted
};

/// Traces importons and builds both maps anew, twice: the first round takes every gather segment for long enough, the
/// second one knows where the global map is read. Sets importonLevels of both maps' settings. Waits for the device.
void buildImportance(const Stage& stage, Parameters& parameters, ImportanceMap& caustic, ImportanceMap& global,
                     const ImportanceJob& job);

}  // namespace importon
