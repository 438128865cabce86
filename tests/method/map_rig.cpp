#include "method/map_rig.h"

#include <algorithm>

#include "shared/bindings.h"

namespace importon::test {

MapRig::MapRig(gpu::Context& context, const Scene& scene, const RenderJob& job)
    : features_(findFeatures(scene, job)), context_(context) {
  const glm::ivec2 size = chooseSize(chooseCamera(scene, job), job);
  kernels_ = makeKernels(context, features_, job);
  deviceScene_ = uploadScene(context, scene, buildBvh(scene.positions, scene.triangles));
  plan = planPasses(job, features_, size, context.limits());
  parameters = makeParameters(job, scene, plan, size);
  work_.emplace(context, plan.workspace);
  deviceScene_.bind(work_->table);
  recorder_.emplace(context);
  stage_.emplace(Stage{context, *recorder_, kernels_, *work_});
  importance = makeImportanceMaps(context, plan.importons * (std::uint64_t{parameters.maxDepth} + 1),
                                  plan.workspace.hasDifferentials);
}

void MapRig::findImportance() {
  buildImportance(*stage_, parameters, importance, plan.importons, plan.nearestImportons, features_.needsCausticMap);
}

ImportonsFound MapRig::importons(MapKind kind) const {
  const ImportanceMap& map = kind == MapKind::caustic ? importance.caustic : importance.global;
  const std::uint64_t sites = (map.count + kImportonsPerSite - 1) / kImportonsPerSite;
  return {map.grid.points.download<MapPoint>(sites), map.importance.download<float>(sites)};
}

ExpectedDensity MapRig::countPilot(MapKind kind) {
  ExpectedDensity expected(context_, kind, plan.mapCapacity);
  work_->parameters.upload(std::span<const Parameters>(&parameters, 1));
  recorder_->fill(work_->counters, 0);
  for (std::uint32_t first = 0; first < plan.photons; first += plan.batch) {
    tracePhotons(*stage_, {kind, nullptr, true}, first, std::min(plan.batch, plan.photons - first), parameters.maxDepth);
    expected.count(*stage_, kind == MapKind::caustic ? importance.caustic : importance.global);
  }
  recorder_->submitAndWait();
  return expected;
}

PhotonMap MapRig::shoot(MapKind kind, const StorageRule& rule, std::uint64_t capacity) {
  const ImportanceMap& required = kind == MapKind::caustic ? importance.caustic : importance.global;
  PhotonMap map(context_, kind, capacity != 0 ? capacity : plan.mapCapacity, plan.workspace.records);
  work_->parameters.upload(std::span<const Parameters>(&parameters, 1));
  recorder_->fill(work_->counters, 0);
  map.begin(*stage_);
  for (std::uint32_t first = 0; first < plan.photons; first += plan.batch) {
    tracePhotons(*stage_, {kind, nullptr}, first, std::min(plan.batch, plan.photons - first), parameters.maxDepth);
    map.addBatch(*stage_, required, rule);
  }
  map.finish(*stage_, required);
  recorder_->submitAndWait();
  return map;
}

std::vector<MapPoint> MapRig::photons(const PhotonMap& map) const {
  gpu::BindingTable table;
  map.bindFinished(table);
  return table.get(kBindingStoredPoints)->download<MapPoint>(counts(map).stored);
}

}  // namespace importon::test
