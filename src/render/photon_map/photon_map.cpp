#include "render/photon_map/photon_map.h"

#include <algorithm>

#include "render/lists/lists.h"
#include "render/lists/room.h"
#include "shared/bindings.h"
#include "shared/push_data.h"

namespace importon {

using gpu::TexelFormat;

PhotonMap::PhotonMap(gpu::Context& context, MapKind kind, std::uint64_t capacity)
    : photons_(context, kind, capacity), mapFlux_(context, "map flux", 0, TexelFormat::uint2) {}

void PhotonMap::begin(const Stage& stage) {
  photons_.clear(stage);
  byCells_.clear(stage);
  byQuota_.clear();
}

void PhotonMap::addBatch(const Stage& stage, const ImportanceMap& importance, const StorageRule& rule) {
  gpu::BindingTable table = stage.work.table;
  importance.bind(table);
  photons_.bind(table);
  table.set(kBindingKeysOut, stage.work.keysA);
  setCounter(stage, kCounterStored, 0, photons_.counter(kMapStored));
  setCounter(stage, kCounterOverflow, 0, photons_.counter(kMapOverflow));
  setCounter(stage, kCounterLevels, 0);

  selectRecords(stage, recordMask(photons_.kind()));
  overTiles(stage, stage.kernels.fluxSum, table, kCounterSelected, FluxSumPush{kSumHits, kCounterSelected});
  isThinned_ = rule.control == DensityControl::probability;
  if (isThinned_)
    storeByProbability(stage, table, photons_, rule);
  else if (rule.control == DensityControl::off)
    storeAll(stage, table, photons_);
  else if (rule.receivers == 0)
    byCells_.control(stage, table, photons_);
  else
    byQuota_.control(stage, table, photons_, grid_, importance, rule);
  setCounter(stage, photons_.counter(kMapStored), 0, kCounterStored);
  setCounter(stage, photons_.counter(kMapOverflow), 0, kCounterOverflow);
  addCounter(stage, kCounterSelected, photons_.counter(kMapHits));
}

void PhotonMap::finish(const Stage& stage, const ImportanceMap& importance, uint nearest) {
  setCounter(stage, kCounterStored, 0, photons_.counter(kMapStored));
  photons_.sortInto(stage, grid_, importance, true);
  if (mapFlux_.bytes() < grid_.room() * sizeof(uvec2)) resize(stage, mapFlux_, grid_.room() * sizeof(uvec2));
  setCounter(stage, levelsCounter(), 0, kCounterStoredLevels);
  gpu::BindingTable table = stage.work.table;
  photons_.bind(table);
  table.set(kBindingValuesIn, grid_.order);
  table.set(kBindingPointsOut, mapFlux_);
  overTiles(stage, stage.kernels.fluxSum, table, kCounterStored, FluxSumPush{kSumMap, kCounterStored});
  overItems(stage, stage.kernels.photonResolve, table, kCounterStored);
  if (nearest == 0) return;
  nearest_.reset();  // its memory is needed
  nearest_.emplace(stage, photons_, nearest);
}

void PhotonMap::estimateIrradiance(const Stage& stage, const ImportanceMap& importance, bool atPhotons) {
  const std::uint64_t points = atPhotons ? grid_.room() : std::max<std::uint64_t>(importance.sites(), 1);
  if (irradiance_.bytes() < points * sizeof(uvec2)) {
    stage.recorder.submitAndWait();  // what was recorded uses the old one
    irradiance_ = gpu::Buffer(stage.gpu, "irradiance", points * sizeof(uvec2), TexelFormat::uint2);
  }
  isIrradianceAtPhotons_ = atPhotons;
  gpu::BindingTable table = stage.work.table;
  importance.bind(table);
  bindFinished(table);
  table.set(kBindingPoints, atPhotons ? grid_.points : importance.grid.points);
  table.set(kBindingPointsOut, irradiance_);
  const IrradianceEstimatePush push{static_cast<uint>(points), photons_.kind() == MapKind::global, atPhotons,
                                    levelsCounter()};
  if (atPhotons)
    overItems(stage, stage.kernels.irradianceEstimate, table, kCounterStored, push);
  else
    stage.recorder.dispatch(stage.kernels.irradianceEstimate, table, push.count, push);
}

void PhotonMap::bindIrradiance(gpu::BindingTable& table) const {
  bindStored(table, grid_);
  table.set(kBindingMapFlux, irradiance_);
}

MapIrradiancePush PhotonMap::irradiancePush(uint source) const {
  return {source, photons_.kind() == MapKind::global, isIrradianceAtPhotons_, levelsCounter()};
}

void PhotonMap::bindNearest(gpu::BindingTable& table) const {
  if (nearest_->isEmpty())
    bindFinished(table);
  else
    nearest_->bind(table);
}

void PhotonMap::bindFinished(gpu::BindingTable& table) const {
  bindStored(table, grid_);
  table.set(kBindingMapFlux, mapFlux_);
}

PhotonMapCounts PhotonMap::readCounts(const Stage& stage, float fluxScale) const {
  const auto counters = stage.work.counters.download<uint>(kCounterCount);
  const auto totals = photons_.totals().download<std::uint64_t>(9);  // hits, map, kept; two words each, low word first
  PhotonMapCounts counts;
  counts.hits = sumOf(counters, photons_.counter(kMapHits));
  counts.stored = counters[photons_.counter(kMapStored)];
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
  const uint count = counters[photons_.counter(kMapStored)];
  return count > 0 ? grid_.points.download<MapPoint>(count) : std::vector<MapPoint>();
}

std::uint64_t PhotonMap::bytes() const {
  return photons_.bytes() + byCells_.bytes() + byQuota_.bytes() + grid_.bytes() + mapFlux_.allocatedBytes() +
         (nearest_ ? nearest_->bytes() : 0) + irradiance_.allocatedBytes();
}

}  // namespace importon
