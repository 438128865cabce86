#include "render/photon_map/nearest_grid.h"

#include <algorithm>
#include <bit>

#include "render/lists/room.h"
#include "shared/bindings.h"

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
  gpu::BindingTable table = stage.work.table;
  photons.bind(table);
  table.set(kBindingKeysOut, stage.work.keysA);
  const PhotonEntriesPush push{grid_.slotMask, levels_};
  overItems(stage, stage.kernels.photonEntries, table, kCounterEntries, push);
  sortIntoCells(stage, grid_, kCounterEntries);
  table.set(kBindingValuesIn, grid_.order);
  table.set(kBindingPointsOut, grid_.points);
  table.set(kBindingWeightsOut, flux_);
  overItems(stage, stage.kernels.photonEntryPoints, table, kCounterEntries, push);
}

void NearestGrid::bind(gpu::BindingTable& table) const {
  bindStored(table, grid_);
  table.set(kBindingMapFlux, flux_);
}

}  // namespace importon
