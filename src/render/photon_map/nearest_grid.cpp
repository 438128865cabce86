#include "render/photon_map/nearest_grid.h"

#include <algorithm>
#include <bit>

#include "kernels/photon_crowds.h"
#include "kernels/photon_entries.h"
#include "kernels/photon_entry_points.h"
#include "render/lists/room.h"

namespace importon {
namespace {

constexpr int kFinestLevel = 20;   // lib/grid.glsl
constexpr int kCoarserLevels = 4;  // than those in use, for places with few photons
// Photons in the cells of the finest level, whatever M is: fewer may share a slot by chance alone; of more, a lookup,
// which searches up to 27 cells, would have too many.
constexpr uint kFewestInCell = 32, kMostInCell = 256;

/// The coarsest level, from `coarsest` on, of which no cell holds more than `most` photons; kFinestLevel if there is
/// none. Waits for the device.
int finestNeeded(const Stage& stage, const StoredPhotons& photons, int coarsest, uint most) {
  const PointGrid grid(stage.gpu, "crowds", 0, photons.count());
  int level = coarsest;
  for (; level < kFinestLevel; ++level) {
    stage.recorder.fill(grid.cells, 0);
    setCounter(stage, kCounterLargestCrowd, 0);
    overItems<kernels::PhotonCrowds>(stage, kCounterStored,
                                     {.slotMask = grid.slotMask, .level = static_cast<uint>(level)}, photons.buffers(),
                                     importon::buffers::Counts{grid.cells});
    stage.recorder.submitAndWait();
    if (readCounter(stage, kCounterLargestCrowd) <= most) break;
  }
  return level;
}

/// Levels to stand at if photons are at those of `used` and `finest` is needed too. What does not fit into lists of
/// `mostEntries` is left out from the finest level on: lookups there take some photons for all.
uint levelsFor(uint used, int finest, uint photons, std::uint64_t mostEntries) {
  const int coarsest = std::max(std::countr_zero(used) - kCoarserLevels, 0);
  uint levels = (2u << finest) - (1u << coarsest);
  while (std::popcount(levels) > 1 && std::uint64_t{photons} * static_cast<uint>(std::popcount(levels)) > mostEntries)
    levels ^= std::bit_floor(levels);
  return levels;
}

constexpr int kLevelsInTurn = 4;

}  // namespace

NearestGrid::NearestGrid(const Stage& stage, const StoredPhotons& photons, uint nearest) : nearest_(nearest) {
  stage.recorder.submitAndWait();
  const auto counters = stage.work.counters.download<uint>(kCounterCount);
  const uint used = counters[kCounterStoredLevels], stored = counters[kCounterStored];
  if (used == 0) return;
  const int finest = finestNeeded(stage, photons, static_cast<int>(std::bit_width(used)) - 1,
                                  std::clamp(nearest, kFewestInCell, kMostInCell));
  levels_ = levelsFor(used, finest, stored, stage.work.size.entries);
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

std::vector<uint> NearestGrid::levelsInTurn() const {
  std::vector<uint> turns;
  uint left = levels_;
  while (left != 0 && (turns.empty() || std::popcount(left) > 1)) {
    uint turn = 0, coarsest = 0;
    for (int i = 0; i < kLevelsInTurn && left != 0; ++i, left ^= coarsest) turn |= coarsest = std::bit_floor(left);
    if (left != 0) left |= coarsest;
    turns.push_back(turn);
  }
  return turns;
}

}  // namespace importon
