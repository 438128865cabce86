#include "render/photon_map.h"

#include <algorithm>
#include <bit>

#include "shared/bindings.h"
#include "shared/push_data.h"

namespace importon {

using gpu::TexelFormat;

namespace {

constexpr std::uint64_t kFluxBytes = 6 * sizeof(uint);  // of a photon: shaders/bindings/photons.glsl

/// A grid that has room for `points`, made anew if it has not.
void makeRoomIn(const Stage& stage, PointGrid& grid, const char* name, std::uint64_t points, std::uint64_t most) {
  if (grid.points && points <= grid.room()) return;
  stage.recorder.submitAndWait();  // what was recorded uses the old one
  grid = {};
  grid = PointGrid(stage.gpu, name, roomFor(points, most));
}

}  // namespace

PhotonMap::PhotonMap(gpu::Context& context, MapKind kind, std::uint64_t capacity)
    : kind_(kind),
      capacity_(capacity),
      points_(context, "photon points", 0, TexelFormat::uint4),
      flux_(context, "photon flux", kFluxBytes),
      mapFlux_(context, "map flux", 0, TexelFormat::uint2),
      totals_(context, "flux totals", 18 * sizeof(uint)) {}

uint PhotonMap::counter(uint which) const {
  return kCounterMap + kCountersPerMap * static_cast<uint>(kind_) + which;
}

void PhotonMap::begin(const Stage& stage) {
  for (const uint which : {kMapStored, kMapOverflow, kMapHits, kMapHits + 1}) setCounter(stage, counter(which), 0);
  stage.recorder.fill(totals_, 0);
  if (cells_) stage.recorder.fill(cells_, kNone);
  hasStored_ = false;
  photons_ = 0;
}

void PhotonMap::makeRoom(const Stage& stage, std::uint64_t photons) {
  if (photons <= points_.bytes() / sizeof(MapPoint)) return;
  const std::uint64_t room = roomFor(photons, capacity_);
  resize(stage, points_, room * sizeof(MapPoint), photons_ * sizeof(MapPoint));
  resize(stage, flux_, room * kFluxBytes, photons_ * kFluxBytes);
}

void PhotonMap::makeRoomForCells(const Stage& stage, std::uint64_t cells) {
  const auto slotsFor = [](std::uint64_t taken) { return taken + taken / 4 + 1; };  // lib/photon_cell.glsl's load of 0.8
  const std::uint64_t most = slotsFor(capacity_), slots = cells_.bytes() / sizeof(PhotonCell);
  if (slots >= std::min(slotsFor(cells), most)) return;
  const gpu::Buffer old = std::move(cells_);
  cells_ = gpu::Buffer(stage.gpu, "photon cells", roomFor(slotsFor(cells), most) * sizeof(PhotonCell));
  stage.recorder.fill(cells_, kNone);
  if (photons_ == 0) return;
  gpu::BindingTable table = stage.work.table;
  table.set(kBindingPhotonCells, cells_);
  table.set(kBindingOldPhotonCells, old);
  stage.recorder.dispatch(stage.kernels.cellMove, table, slots);
  stage.recorder.submitAndWait();  // before the old ones go
}

void PhotonMap::makeRoomForBatch(const Stage& stage) {
  stage.recorder.submitAndWait();
  const uint hits = readCounter(stage, kCounterSelected);
  makeRoomIn(stage, batch_, "batch", hits, stage.work.size.records);
  reserveEntries(stage, hits);
}

void PhotonMap::store(const Stage& stage, gpu::BindingTable& table, bool isWeighted) {
  compact(stage, kCounterSelected, kCounterAccepted, nullptr, stage.work.accepted);
  stage.recorder.submitAndWait();
  const std::uint64_t stored = std::min(photons_ + readCounter(stage, kCounterAccepted), capacity_);
  makeRoom(stage, stored);
  photons_ = stored;
  table.set(kBindingNextQueue, stage.work.accepted);
  overItems(stage, stage.kernels.photonStore, table, kCounterAccepted,
            PhotonStorePush{static_cast<uint>(capacity_), isWeighted});
}

void PhotonMap::countStored(const Stage& stage) const {
  setCounter(stage, kCounterStored, 0, kCounterStored, kCounterAccepted, static_cast<uint>(capacity_));
}

void PhotonMap::addBatch(const Stage& stage, const ImportanceMap& importance, const StorageRule& rule) {
  gpu::BindingTable table = stage.work.table;
  importance.bind(table);
  table.set(kBindingPhotonPoints, points_);
  table.set(kBindingPhotonFlux, flux_);
  table.set(kBindingTotals, totals_);
  table.set(kBindingKeysOut, stage.work.keysA);
  setCounter(stage, kCounterStored, 0, counter(kMapStored));
  setCounter(stage, kCounterOverflow, 0, counter(kMapOverflow));
  setCounter(stage, kCounterLevels, 0);

  selectRecords(stage, recordMask(kind_));
  overTiles(stage, stage.kernels.fluxSum, table, kCounterSelected, FluxSumPush{kSumHits, kCounterSelected});
  const bool isControlled = rule.control == DensityControl::density;
  isThinned_ = rule.control == DensityControl::probability;
  if (isThinned_) {
    controlByProbability(stage, table, rule);
  } else if (isControlled && rule.receivers == 0) {
    controlByCells(stage, table);
  } else {
    if (isControlled) makeRoomForBatch(stage);  // else nothing is searched in it
    overItems(stage, stage.kernels.hitKey, table, kCounterSelected,
              HitKeyPush{kind_ == MapKind::global, batch_.slotMask, isControlled});
    if (isControlled) {
      controlByQuota(stage, table, importance, rule);
    } else {
      store(stage, table);
      countStored(stage);
    }
  }
  hasStored_ = true;
  setCounter(stage, counter(kMapStored), 0, kCounterStored);
  setCounter(stage, counter(kMapOverflow), 0, kCounterOverflow);
  addCounter(stage, kCounterSelected, counter(kMapHits));
}

void PhotonMap::controlByCells(const Stage& stage, gpu::BindingTable& table) {
  stage.recorder.submitAndWait();
  makeRoomForCells(stage, photons_ + readCounter(stage, kCounterSelected));
  const KernelSet& kernels = stage.kernels;
  table.set(kBindingPhotonCells, cells_);
  overItems(stage, kernels.cellFind, table, kCounterSelected, CellFindPush{kind_ == MapKind::global});
  overItems(stage, kernels.cellClaim, table, kCounterSelected);
  store(stage, table);
  overItems(stage, kernels.cellSettle, table, kCounterAccepted, CellSettlePush{static_cast<uint>(capacity_)});
  overItems(stage, kernels.cellAdd, table, kCounterSelected);
  countStored(stage);
}

void PhotonMap::controlByProbability(const Stage& stage, gpu::BindingTable& table, const StorageRule& rule) {
  rule.expected->bind(table);
  overItems(stage, stage.kernels.photonThin, table, kCounterSelected,
            PhotonThinPush{kind_ == MapKind::global, rule.probabilityFloor});
  overTiles(stage, stage.kernels.fluxSum, table, kCounterSelected, FluxSumPush{kSumKept, kCounterSelected});
  store(stage, table, true);
  countStored(stage);
}

void PhotonMap::controlByQuota(const Stage& stage, gpu::BindingTable& table, const ImportanceMap& importance,
                               const StorageRule& rule) {
  const KernelSet& kernels = stage.kernels;
  buildGrid(stage, batch_, kCounterSelected, stage.work.selectedPoints);
  table.set(kBindingValuesIn, batch_.order);
  if (hasStored_) {
    bindStored(table, stored_);
    overItems(stage, kernels.photonQuota, table, kCounterSelected, PhotonQuotaPush{0, 0, rule.acceptance, rule.fewest});
  }
  bindStored(table, batch_);
  overItems(stage, kernels.photonQuota, table, kCounterSelected, PhotonQuotaPush{1, hasStored_, rule.acceptance, rule.fewest});
  store(stage, table);
  countStored(stage);
  buildStoredGrid(stage, importance, false);
  bindStored(table, stored_);
  overItems(stage, kernels.photonRedistribute, table, kCounterSelected, PhotonRedistributePush{rule.receivers, rule.shares});
  store(stage, table);  // those without a receiver
  countStored(stage);
}

void PhotonMap::buildStoredGrid(const Stage& stage, const ImportanceMap& importance, bool isFinished) {
  makeRoomIn(stage, stored_, "stored photons", photons_, capacity_);
  reserveEntries(stage, photons_);
  gpu::BindingTable table = stage.work.table;
  importance.bind(table);
  table.set(kBindingPhotonPoints, points_);
  table.set(kBindingPhotonFlux, flux_);
  table.set(kBindingKeysOut, stage.work.keysA);
  setCounter(stage, kCounterStoredLevels, 0);
  overItems(stage, stage.kernels.photonKey, table, kCounterStored, 
            PhotonKeyPush{isFinished, kind_ == MapKind::global, stored_.slotMask});
  buildGrid(stage, stored_, kCounterStored, points_);
}

void PhotonMap::finish(const Stage& stage, const ImportanceMap& importance, uint nearest) {
  setCounter(stage, kCounterStored, 0, counter(kMapStored));
  buildStoredGrid(stage, importance, true);
  if (mapFlux_.bytes() < stored_.room() * sizeof(uvec2)) resize(stage, mapFlux_, stored_.room() * sizeof(uvec2));
  setCounter(stage, counter(kMapLevels), 0, kCounterStoredLevels);
  gpu::BindingTable table = stage.work.table;
  table.set(kBindingPhotonPoints, points_);
  table.set(kBindingPhotonFlux, flux_);
  table.set(kBindingTotals, totals_);
  table.set(kBindingValuesIn, stored_.order);
  table.set(kBindingPointsOut, mapFlux_);
  overTiles(stage, stage.kernels.fluxSum, table, kCounterStored, FluxSumPush{kSumMap, kCounterStored});
  overItems(stage, stage.kernels.photonResolve, table, kCounterStored);
  if (nearest > 0) buildNearestGrid(stage, nearest);
}

namespace {
constexpr int kFinestLevel = 20;  // lib/grid.glsl
}

void PhotonMap::buildNearestGrid(const Stage& stage, uint nearest) {
  constexpr int kCoarserLevels = 4;  // than those in use, for places with few photons
  constexpr int kFinerLevels = 3;    // for places with many, where nothing controls the density
  stage.recorder.submitAndWait();
  const auto counters = stage.work.counters.download<uint>(kCounterCount);
  const uint used = counters[kCounterStoredLevels], stored = counters[kCounterStored];
  nearest_.reset();
  nearest_.emplace();
  nearest_->photons = nearest;
  if (used == 0) return;
  const int finest = std::min(static_cast<int>(std::bit_width(used)) - 1 + kFinerLevels, kFinestLevel);
  const int coarsest = std::max(std::countr_zero(used) - kCoarserLevels, 0);
  uint levels = (2u << finest) - (1u << coarsest);
  // What does not fit is left out from the finest level on: cells then hold more photons than the search needs.
  while (std::popcount(levels) > 1 && std::uint64_t{stored} * static_cast<uint>(std::popcount(levels)) > stage.work.size.entries)
    levels ^= std::bit_floor(levels);
  const uint entries = stored * static_cast<uint>(std::popcount(levels));
  nearest_->levels = levels;
  nearest_->grid = PointGrid(stage.gpu, "nearest photons", entries);
  nearest_->flux = gpu::Buffer(stage.gpu, "flux of nearest photons", entries * sizeof(uvec2), TexelFormat::uint2);
  setCounter(stage, kCounterEntries, entries);
  reserveEntries(stage, entries);
  gpu::BindingTable table = stage.work.table;
  table.set(kBindingPhotonPoints, points_);
  table.set(kBindingPhotonFlux, flux_);
  table.set(kBindingKeysOut, stage.work.keysA);
  const PhotonEntriesPush push{nearest_->grid.slotMask, levels};
  overItems(stage, stage.kernels.photonEntries, table, kCounterEntries, push);
  sortIntoCells(stage, nearest_->grid, kCounterEntries);
  table.set(kBindingValuesIn, nearest_->grid.order);
  table.set(kBindingPointsOut, nearest_->grid.points);
  table.set(kBindingWeightsOut, nearest_->flux);
  overItems(stage, stage.kernels.photonEntryPoints, table, kCounterEntries, push);
}

void PhotonMap::estimateIrradiance(const Stage& stage, const ImportanceMap& importance, bool atPhotons) {
  const std::uint64_t points = atPhotons ? stored_.room() : std::max<std::uint64_t>(importance.sites(), 1);
  if (irradiance_.bytes() < points * sizeof(uvec2)) {
    stage.recorder.submitAndWait();  // what was recorded uses the old one
    irradiance_ = gpu::Buffer(stage.gpu, "irradiance", points * sizeof(uvec2), TexelFormat::uint2);
  }
  isIrradianceAtPhotons_ = atPhotons;
  gpu::BindingTable table = stage.work.table;
  importance.bind(table);
  bindFinished(table);
  table.set(kBindingPoints, atPhotons ? stored_.points : importance.grid.points);
  table.set(kBindingPointsOut, irradiance_);
  const IrradianceEstimatePush push{static_cast<uint>(points), kind_ == MapKind::global, atPhotons, levelsCounter()};
  if (atPhotons) overItems(stage, stage.kernels.irradianceEstimate, table, kCounterStored, push);
  else stage.recorder.dispatch(stage.kernels.irradianceEstimate, table, push.count, push);
}

void PhotonMap::bindIrradiance(gpu::BindingTable& table) const {
  bindStored(table, stored_);
  table.set(kBindingMapFlux, irradiance_);
}

MapIrradiancePush PhotonMap::irradiancePush(uint source) const {
  return {source, kind_ == MapKind::global, isIrradianceAtPhotons_, levelsCounter()};
}

MapNearestPush PhotonMap::nearestPush(uint source) const {
  return {source, kind_ == MapKind::global, nearest_->levels, nearest_->photons};
}

void PhotonMap::bindNearest(gpu::BindingTable& table) const {
  if (nearest_->levels == 0) return bindFinished(table);
  bindStored(table, nearest_->grid);
  table.set(kBindingMapFlux, nearest_->flux);
}

void PhotonMap::bindFinished(gpu::BindingTable& table) const {
  bindStored(table, stored_);
  table.set(kBindingMapFlux, mapFlux_);
}

PhotonMapCounts PhotonMap::readCounts(const Stage& stage, float fluxScale) const {
  const auto counters = stage.work.counters.download<uint>(kCounterCount);
  const auto totals = totals_.download<std::uint64_t>(9);  // hits, map, kept; two words each, low word first
  PhotonMapCounts counts;
  counts.hits = sumOf(counters, counter(kMapHits));
  counts.stored = counters[counter(kMapStored)];
  counts.overflow = overflow(counters);
  counts.redistributed = isThinned_ ? 0 : counts.hits - counts.stored - counts.overflow;
  for (std::size_t c = 0; c < 3; ++c) {
    counts.fluxHits[c] = static_cast<double>(totals[c]) / static_cast<double>(fluxScale);
    counts.fluxMap[c] = static_cast<double>(totals[3 + c]) / static_cast<double>(fluxScale);
    counts.isEnergyExact = counts.isEnergyExact && totals[(isThinned_ ? 6 : 0) + c] == totals[3 + c];
  }
  return counts;
}

std::vector<MapPoint> PhotonMap::readPoints(const Stage& stage) const {
  const auto counters = stage.work.counters.download<uint>(kCounterCount);
  const uint count = counters[counter(kMapStored)];
  return count > 0 ? stored_.points.download<MapPoint>(count) : std::vector<MapPoint>();
}

std::uint64_t PhotonMap::bytes() const {
  std::uint64_t bytes = stored_.bytes() + batch_.bytes();
  for (const gpu::Buffer* buffer : {&points_, &flux_, &mapFlux_, &totals_, &cells_, &irradiance_})
    bytes += buffer->allocatedBytes();
  if (nearest_) bytes += nearest_->grid.bytes() + nearest_->flux.allocatedBytes();
  return bytes;
}

}  // namespace importon
