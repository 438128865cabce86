#include "render/photon_map/nearest_grid.h"

#include <algorithm>
#include <bit>

#include "kernels/photon_entries.h"
#include "kernels/photon_entry_points.h"
#include "render/lists/room.h"

namespace importon {
namespace {

constexpr int kFinestLevel = 20;   // lib/grid.glsl
constexpr int kCoarserLevels = 4;  // than those in use, for places with few photons
constexpr int kFinerLevels = 3;    // for places with many, where nothing controls the density

/// Levels to stand at if photons are at those of `used`. What does not fit into lists of `mostEntries` is left out from
/// the finest level on: cells then hold more photons than the search needs.
uint levelsFor(uint used, uint photons, std::uint64_t mostEntries) {
  const int finest = std::min(static_cast<int>(std::bit_width(used)) - 1 + kFinerLevels, kFinestLevel);
  const int coarsest = std::max(std::countr_zero(used) - kCoarserLevels, 0);
  uint levels = (2u << finest) - (1u << coarsest);
  while (std::popcount(levels) > 1 && std::uint64_t{photons} * static_cast<uint>(std::popcount(levels)) > mostEntries)
    levels ^= std::bit_floor(levels);
  return levels;
}

}  // namespace

NearestGrid::NearestGrid(const Stage& stage, const StoredPhotons& photons, uint nearest) : nearest_(nearest) {
  stage.recorder.submitAndWait();
  const auto counters = stage.work.counters.download<uint>(kCounterCount);
  const uint used = counters[kCounterStoredLevels], stored = counters[kCounterStored];
  if (used == 0) return;
  levels_ = levelsFor(used, stored, stage.work.size.entries);
  const uint entries = stored * static_cast<uint>(std::popcount(levels_));
  grid_ = PointGrid(stage.gpu, "nearest photons", entries);
  flux_ = gpu::Buffer(stage.gpu, "flux of nearest photons", entries * sizeof(uvec2), gpu::TexelFormat::uint2);
  setCounter(stage, kCounterEntries, entries);
  reserveEntries(stage, entries);
  overItems<kernels::PhotonEntries>(stage, kCounterEntries, {.slotMask = grid_.slotMask, .levels = levels_},
                                    photons.buffers(), importon::buffers::Keys{stage.work.keysA});
  sortIntoCells(stage, grid_, kCounterEntries);
  overItems<kernels::PhotonEntryPoints>(stage, kCounterEntries, {.slotMask = grid_.slotMask, .levels = levels_},
                                        photons.buffers(), importon::buffers::Order{grid_.order},
                                        importon::buffers::PointsOut{grid_.points}, importon::buffers::MapFlux{flux_});
}

}  // namespace importon
