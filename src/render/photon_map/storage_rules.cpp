#include "render/photon_map/storage_rules.h"

#include <algorithm>

#include "render/lists/room.h"
#include "shared/bindings.h"
#include "shared/push_data.h"

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
  gpu::BindingTable table = stage.work.table;
  table.set(kBindingPhotonCells, cells_);
  table.set(kBindingOldPhotonCells, old);
  stage.recorder.dispatch(stage.kernels.cellMove, table, slots);
  stage.recorder.submitAndWait();  // before the old ones go
}

void StorageByCells::control(const Stage& stage, gpu::BindingTable& table, StoredPhotons& photons) {
  stage.recorder.submitAndWait();
  makeRoom(stage, photons.count() + readCounter(stage, kCounterSelected), photons);
  const KernelSet& kernels = stage.kernels;
  table.set(kBindingPhotonCells, cells_);
  overItems(stage, kernels.cellFind, table, kCounterSelected, CellFindPush{photons.kind() == MapKind::global});
  overItems(stage, kernels.cellClaim, table, kCounterSelected);
  photons.store(stage, table);
  overItems(stage, kernels.cellSettle, table, kCounterAccepted, CellSettlePush{static_cast<uint>(photons.capacity())});
  overItems(stage, kernels.cellAdd, table, kCounterSelected);
  photons.countStored(stage);
}

void StorageByQuota::control(const Stage& stage, gpu::BindingTable& table, StoredPhotons& photons, PointGrid& grid,
                             const ImportanceMap& importance, const StorageRule& rule) {
  const KernelSet& kernels = stage.kernels;
  if (isGridOld_) photons.sortInto(stage, grid, importance, false);
  stage.recorder.submitAndWait();
  const uint hits = readCounter(stage, kCounterSelected);
  makeRoomIn(stage, batch_, "batch", hits, stage.work.size.records);
  reserveEntries(stage, hits);
  overItems(stage, kernels.hitKey, table, kCounterSelected,
            HitKeyPush{photons.kind() == MapKind::global, batch_.slotMask, true});
  buildGrid(stage, batch_, kCounterSelected, stage.work.selectedPoints);
  table.set(kBindingValuesIn, batch_.order);
  if (hasStored_) {
    bindStored(table, grid);
    overItems(stage, kernels.photonQuota, table, kCounterSelected, PhotonQuotaPush{0, 0, rule.acceptance, rule.fewest});
  }
  bindStored(table, batch_);
  overItems(stage, kernels.photonQuota, table, kCounterSelected,
            PhotonQuotaPush{1, hasStored_, rule.acceptance, rule.fewest});
  photons.store(stage, table);
  photons.countStored(stage);
  photons.sortInto(stage, grid, importance, false);
  bindStored(table, grid);
  overItems(stage, kernels.photonRedistribute, table, kCounterSelected,
            PhotonRedistributePush{rule.receivers, rule.shares});
  const std::uint64_t inGrid = photons.count();
  photons.store(stage, table);  // those without a receiver
  photons.countStored(stage);
  isGridOld_ = photons.count() > inGrid;
  hasStored_ = true;
}

void storeByProbability(const Stage& stage, gpu::BindingTable& table, StoredPhotons& photons, const StorageRule& rule) {
  rule.expected->bind(table);
  overItems(stage, stage.kernels.photonThin, table, kCounterSelected,
            PhotonThinPush{photons.kind() == MapKind::global, rule.probabilityFloor});
  overTiles(stage, stage.kernels.fluxSum, table, kCounterSelected, FluxSumPush{kSumKept, kCounterSelected});
  photons.store(stage, table, true);
  photons.countStored(stage);
}

void storeAll(const Stage& stage, gpu::BindingTable& table, StoredPhotons& photons) {
  overItems(stage, stage.kernels.hitKey, table, kCounterSelected,
            HitKeyPush{photons.kind() == MapKind::global, 0, false});
  photons.store(stage, table);
  photons.countStored(stage);
}

}  // namespace importon
