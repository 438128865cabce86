#include "render/photon_map/storage_rules.h"

#include <algorithm>

#include "kernels/cell_add.h"
#include "kernels/cell_claim.h"
#include "kernels/cell_find.h"
#include "kernels/cell_move.h"
#include "kernels/cell_settle.h"
#include "kernels/flux_sum.h"
#include "kernels/hit_key.h"
#include "kernels/photon_quota.h"
#include "kernels/photon_redistribute.h"
#include "kernels/photon_thin.h"
#include "render/lists/room.h"

namespace importon {

void StorageByCells::clear(const Stage& stage) {
  if (cells_) stage.recorder.fill(cells_, kNone);
}

void StorageByCells::makeRoom(const Stage& stage, std::uint64_t cells, const StoredPhotons& photons) {
  const auto slotsFor = [](std::uint64_t taken) {
    return taken + taken / 4 + 1;
  };  // lib/photon_cell.glsl's load of 0.8
  const std::uint64_t most = slotsFor(photons.capacity()), slots = cells_.bytes() / sizeof(PhotonCell);
  if (slots >= std::min(slotsFor(cells), most)) return;
  const gpu::Buffer old = std::move(cells_);
  cells_ = gpu::Buffer(stage.gpu, "photon cells", roomFor(slotsFor(cells), most) * sizeof(PhotonCell));
  stage.recorder.fill(cells_, kNone);
  if (photons.count() == 0) return;
  run<kernels::CellMove>(stage, slots, {}, buffers::PhotonCells{cells_}, buffers::OldCells{old});
  stage.recorder.submitAndWait();  // before the old ones go
}

void StorageByCells::control(const Stage& stage, StoredPhotons& photons, const ImportanceMap& importance) {
  stage.recorder.submitAndWait();
  makeRoom(stage, photons.count() + readCounter(stage, kCounterSelected), photons);
  const buffers::PhotonCells cells{cells_};
  const buffers::Homes homes{stage.work.neighbours};
  overItems<kernels::CellFind>(stage, kCounterSelected, {.isGlobal = photons.kind() == MapKind::global}, cells, homes,
                               importance.buffers());
  overItems<kernels::CellClaim>(stage, kCounterSelected, {}, cells, homes);
  photons.store(stage);
  overItems<kernels::CellSettle>(stage, kCounterAccepted, {.capacity = static_cast<uint>(photons.capacity())}, cells,
                                 homes);
  overItems<kernels::CellAdd>(stage, kCounterSelected, {}, cells, homes, photons.buffers());
  photons.countStored(stage);
}

void StorageByQuota::control(const Stage& stage, StoredPhotons& photons, PointGrid& grid,
                             const ImportanceMap& importance, const StorageRule& rule) {
  if (isGridOld_) photons.sortInto(stage, grid, importance, false);
  stage.recorder.submitAndWait();
  const uint hits = readCounter(stage, kCounterSelected);
  makeRoomIn(stage, batch_, "batch", hits, stage.work.size.records);
  reserveEntries(stage, hits);
  overItems<kernels::HitKey>(
      stage, kCounterSelected,
      {.isGlobal = photons.kind() == MapKind::global, .slotMask = batch_.slotMask, .isControlled = true},
      importance.buffers(), buffers::Keys{stage.work.keysA});
  buildGrid(stage, batch_, kCounterSelected, stage.work.selectedPoints);
  const auto compareWithQuota = [&](const PointGrid& among, bool isBatch) {
    overItems<kernels::PhotonQuota>(
        stage, kCounterSelected,
        {.isBatch = isBatch, .hasStored = isBatch && hasStored_, .acceptance = rule.acceptance, .fewest = rule.fewest},
        SearchedGrid(among), buffers::Order{batch_.order}, importance.buffers());
  };
  if (hasStored_) compareWithQuota(grid, false);
  compareWithQuota(batch_, true);
  photons.store(stage);
  photons.countStored(stage);
  photons.sortInto(stage, grid, importance, false);
  overItems<kernels::PhotonRedistribute>(stage, kCounterSelected, {.receivers = rule.receivers, .shares = rule.shares},
                                         SearchedGrid(grid), photons.buffers(), importance.buffers());
  const std::uint64_t inGrid = photons.count();
  photons.store(stage);  // those without a receiver
  photons.countStored(stage);
  isGridOld_ = photons.count() > inGrid;
  hasStored_ = true;
}

void storeByProbability(const Stage& stage, StoredPhotons& photons, const ImportanceMap& importance,
                        const StorageRule& rule) {
  overItems<kernels::PhotonThin>(
      stage, kCounterSelected,
      {.isGlobal = photons.kind() == MapKind::global, .floorProbability = rule.probabilityFloor}, importance.buffers(),
      buffers::PhotonCells{rule.expected->cells()});
  overTiles<kernels::FluxSum>(stage, kCounterSelected, {.what = kSumKept, .source = kCounterSelected},
                              photons.buffers());
  photons.store(stage, true);
  photons.countStored(stage);
}

void storeAll(const Stage& stage, StoredPhotons& photons, const ImportanceMap& importance) {
  overItems<kernels::HitKey>(stage, kCounterSelected,
                             {.isGlobal = photons.kind() == MapKind::global, .slotMask = 0, .isControlled = false},
                             importance.buffers(), buffers::Keys{stage.work.keysA});
  photons.store(stage);
  photons.countStored(stage);
}

}  // namespace importon
