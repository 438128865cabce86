#include "render/photons/photon_system.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "render/lists/lists.h"

namespace importon {

PhotonSystem::PhotonSystem(PassContext& context, MapKind k)
    : kind(k),
      isUsed(context.hasMaps() && context.features.needsPhotons(k)),
      importance(makeImportanceMap(context.device->context, k,
                                   context.plan.importons * (std::uint64_t{context.parameters.maxDepth} + 1),
                                   context.plan.workspace.hasDifferentials)),
      control(context.job.control) {
  if (isUsed && context.features.needsPhotonMap(kind))
    map.emplace(context.device->context, kind, context.plan.capacityFor(kind));
}

PhotonSource PhotonSystem::source(bool isPilot) const {
  return {kind, emission ? &*emission : nullptr, isPilot, scatter ? &*scatter : nullptr};
}

StorageRule PhotonSystem::storageRule(const PassPlan& plan) const {
  StorageRule rule = plan.storage;
  rule.control = control;
  rule.expected = expected ? &*expected : nullptr;
  return rule;
}

void PhotonSystem::shoot(PassContext& context, bool isFirst, const std::function<void()>& addBatch) {
  if (!map && !addBatch) return;
  const Stage stage = context.stage();
  const bool isTraining = emission && isFirst && static_cast<int>(context.parameters.pass) < kTrainingPasses;
  if (map) map->begin(stage);
  const std::uint32_t photons = context.now.photonsFor(kind), batch = context.plan.batch;
  for (std::uint32_t first = 0; first < photons; first += batch) {
    tracePhotons(stage, source(false), first, std::min(batch, photons - first), context.parameters.maxDepth);
    if (addBatch) addBatch();
    if (map)
      map->addBatch(stage, importance, storageRule(context.plan));
    else if (isTraining)
      selectRecords(stage, recordMask(kind));
    if (isTraining) emission->train(stage, importance, context.meanImportance());
  }
  if (!map) return;
  map->finish(stage, importance, context.plan.nearestPhotons);
  if (context.job.irradiance != IrradianceCache::off && traitsOf(kind).isGathered)
    map->estimateIrradiance(stage, importance, context.job.irradiance == IrradianceCache::photons);
}

void PhotonSystem::endPass(const PassContext& context) {
  if (emission && static_cast<int>(context.parameters.pass) < kTrainingPasses) emission->update();
}

std::uint64_t PhotonSystem::bytes() const { return (map ? map->bytes() : 0) + (expected ? expected->bytes() : 0); }

void PhotonSystem::addKept(std::vector<Kept>& state, Parameters& parameters) {
  const std::string name = traitsOf(kind).name;
  state.push_back(keep(name + " importon hits", importance.hits));
  if (emission) state.push_back(keep(name + " guide", emission->memory()));
  state.push_back(keep(name + " density limit", (parameters.*traitsOf(kind).settings).densityLimit));
  state.push_back(keep(name + " control", control));
}

void PhotonSystem::restored(int passes) {
  for (int pass = 0; emission && pass < std::min(passes, kTrainingPasses); ++pass) emission->update();
}

void tightenDensityLimit(PassContext& context, PhotonSystem& caustic, PhotonSystem& global) {
  const std::uint64_t mostPhotons = std::max(context.plan.mapCapacity, context.plan.causticCapacity);
  const double first = 4 * static_cast<double>(mostPhotons) / context.deviceScene.area;
  const float limit = std::min(0.5f * context.parameters.globalMap.densityLimit, static_cast<float>(first));
  if (limit * context.deviceScene.area < 1)
    throw DeviceError("the photon maps", fmt::format("no room for {} photons", mostPhotons), "raise --memory");
  context.parameters.globalMap.densityLimit = context.parameters.causticMap.densityLimit = limit;
  caustic.control = global.control = DensityControl::density;
  context.log.warn("photon map full",
                   "the photon maps need more than --memory allows: fewer photons are stored than "
                   "required, each with more power");
}

}  // namespace importon
