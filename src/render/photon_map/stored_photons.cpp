#include "render/photon_map/stored_photons.h"

#include <algorithm>

#include "kernels/photon_key.h"
#include "kernels/photon_store.h"
#include "render/lists/lists.h"
#include "render/lists/room.h"

namespace importon {
namespace {

constexpr std::uint64_t kFluxBytes = 6 * sizeof(uint);  // of a photon

}  // namespace

StoredPhotons::StoredPhotons(gpu::Context& context, MapKind kind, std::uint64_t capacity)
    : kind_(kind),
      capacity_(capacity),
      points_(context, "photon points", 0, gpu::TexelFormat::uint4),
      flux_(context, "photon flux", kFluxBytes),
      totals_(context, "flux totals", 18 * sizeof(uint)) {}

uint StoredPhotons::counter(uint which) const {
  return kCounterMap + kCountersPerMap * static_cast<uint>(kind_) + which;
}

void StoredPhotons::clear(const Stage& stage) {
  for (const uint which : {kMapStored, kMapOverflow, kMapHits, kMapHits + 1}) setCounter(stage, counter(which), 0);
  stage.recorder.fill(totals_, 0);
  count_ = 0;
}

void StoredPhotons::makeRoom(const Stage& stage, std::uint64_t photons) {
  if (photons <= points_.bytes() / sizeof(MapPoint)) return;
  const std::uint64_t room = roomFor(photons, capacity_);
  resize(stage, points_, room * sizeof(MapPoint), count_ * sizeof(MapPoint));
  resize(stage, flux_, room * kFluxBytes, count_ * kFluxBytes);
}

void StoredPhotons::store(const Stage& stage, bool isWeighted) {
  compact(stage, kCounterSelected, kCounterAccepted, nullptr, stage.work.accepted);
  stage.recorder.submitAndWait();
  const std::uint64_t stored = std::min(count_ + readCounter(stage, kCounterAccepted), capacity_);
  makeRoom(stage, stored);
  count_ = stored;
  overItems<kernels::PhotonStore>(stage, kCounterAccepted,
                                  {.capacity = static_cast<uint>(capacity_), .isWeighted = isWeighted}, buffers());
}

void StoredPhotons::countStored(const Stage& stage) const {
  setCounter(stage, kCounterStored, 0, kCounterStored, kCounterAccepted, static_cast<uint>(capacity_));
}

void StoredPhotons::sortInto(const Stage& stage, PointGrid& grid, const ImportanceMap& importance,
                             bool isFinished) const {
  makeRoomIn(stage, grid, "stored photons", count_, capacity_);
  reserveEntries(stage, count_);
  setCounter(stage, kCounterStoredLevels, 0);
  overItems<kernels::PhotonKey>(
      stage, kCounterStored,
      {.isFinished = isFinished, .isGlobal = kind_ == MapKind::global, .slotMask = grid.slotMask}, buffers(),
      importance.buffers(), importon::buffers::Keys{stage.work.keysA});
  buildGrid(stage, grid, kCounterStored, points_);
}

void makeRoomIn(const Stage& stage, PointGrid& grid, const char* name, std::uint64_t points, std::uint64_t most) {
  if (grid.points && points <= grid.room()) return;
  stage.recorder.submitAndWait();  // what was recorded uses the old one
  grid = {};
  grid = PointGrid(stage.gpu, name, roomFor(points, most));
}

}  // namespace importon
