#include "render/photon_map/photon_map.h"

#include <algorithm>

#include "kernels/flux_sum.h"
#include "kernels/irradiance_estimate.h"
#include "kernels/map_irradiance.h"
#include "kernels/map_lookup.h"
#include "kernels/map_nearest.h"
#include "kernels/photon_resolve.h"
#include "render/lists/lists.h"
#include "render/lists/room.h"

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
  setCounter(stage, kCounterStored, 0, photons_.counter(kMapStored));
  setCounter(stage, kCounterOverflow, 0, photons_.counter(kMapOverflow));
  setCounter(stage, kCounterLevels, 0);

  selectRecords(stage, recordMask(photons_.kind()));
  overTiles<kernels::FluxSum>(stage, kCounterSelected, {.what = kSumHits, .source = kCounterSelected},
                              photons_.buffers());
  isThinned_ = rule.control == DensityControl::probability;
  if (isThinned_)
    storeByProbability(stage, photons_, importance, rule);
  else if (rule.control == DensityControl::off)
    storeAll(stage, photons_, importance);
  else if (rule.receivers == 0)
    byCells_.control(stage, photons_, importance);
  else
    byQuota_.control(stage, photons_, grid_, importance, rule);
  setCounter(stage, photons_.counter(kMapStored), 0, kCounterStored);
  setCounter(stage, photons_.counter(kMapOverflow), 0, kCounterOverflow);
  addCounter(stage, kCounterSelected, photons_.counter(kMapHits));
}

void PhotonMap::finish(const Stage& stage, const ImportanceMap& importance, uint nearest) {
  setCounter(stage, kCounterStored, 0, photons_.counter(kMapStored));
  photons_.sortInto(stage, grid_, importance, true);
  if (mapFlux_.bytes() < grid_.room() * sizeof(uvec2)) resize(stage, mapFlux_, grid_.room() * sizeof(uvec2));
  setCounter(stage, levelsCounter(), 0, kCounterStoredLevels);
  overTiles<kernels::FluxSum>(stage, kCounterStored, {.what = kSumMap, .source = kCounterStored}, photons_.buffers());
  overItems<kernels::PhotonResolve>(stage, kCounterStored, {}, photons_.buffers(), buffers::Order{grid_.order},
                                    buffers::MapFlux{mapFlux_});
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
  const kernels::IrradianceEstimate::Push push{.count = static_cast<uint>(points),
                                               .isGlobal = photons_.kind() == MapKind::global,
                                               .arePhotons = atPhotons,
                                               .levels = levelsCounter()};
  const buffers::Points at{atPhotons ? grid_.points : importance.grid.points};
  const buffers::Irradiance to{irradiance_};
  if (atPhotons)
    overItems<kernels::IrradianceEstimate>(stage, kCounterStored, push, at, to, importance.buffers(), finished());
  else
    run<kernels::IrradianceEstimate>(stage, push.count, push, at, to, importance.buffers(), finished());
}

void PhotonMap::lookUp(const Stage& stage, const ImportanceMap& importance, uint source,
                       const gpu::Buffer& slots) const {
  const uint isGlobal = photons_.kind() == MapKind::global;
  const buffers::Queue queue{slots};
  if (irradiance_.bytes() > 0)
    overItems<kernels::MapIrradiance>(
        stage, source,
        {.source = source, .isGlobal = isGlobal, .arePhotons = isIrradianceAtPhotons_, .levels = levelsCounter()},
        queue, importance.buffers(), SearchedGrid(grid_), buffers::Irradiance{irradiance_});
  if (!nearest_) {
    overItems<kernels::MapLookup>(stage, source, {.source = source, .isGlobal = isGlobal, .levels = levelsCounter()},
                                  queue, importance.buffers(), finished());
    return;
  }
  const std::vector<uint> turns = nearest_->levelsInTurn();
  for (std::size_t i = 0; i < turns.size(); ++i)
    overItems<kernels::MapNearest>(stage, source,
                                   {.source = source,
                                    .isGlobal = isGlobal,
                                    .levels = turns[i],
                                    .isLast = i + 1 == turns.size(),
                                    .nearest = nearest_->nearest()},
                                   queue, importance.buffers(), nearest_->buffers());
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
