#include "method/map_rig.h"

#include <algorithm>
#include <bit>

#include "render/camera/eye_pass.h"
#include "render/lists/lists.h"
#include "render/surface_cache/irradiance_map.h"
#include "shared/ray_data.h"

namespace importon::test {

MapRig::MapRig(gpu::Context& context, const Scene& scene, const RenderJob& job)
    : features_(findFeatures(scene, job)), context_(context) {
  const FilmPlace film = placeFilm(chooseCamera(scene, job), job);
  kernels_.emplace(context, constantsOf(features_, job, context.limits().isCpu), features_.hasAlpha);
  deviceScene_ = uploadScene(context, scene, buildBvh(scene.positions, scene.triangles));
  plan = planPasses(job, features_, film.size, context.limits());
  parameters = makeParameters(job, scene, plan, film);
  work_.emplace(context, plan.workspace);
  recorder_.emplace(context);
  stage_.emplace(Stage{context, *recorder_, *kernels_, *work_, deviceScene_});
  const auto makeMap = [&](MapKind kind) {
    return makeImportanceMap(context, kind, plan.importons * (std::uint64_t{parameters.maxDepth} + 1),
                             plan.workspace.hasDifferentials);
  };
  importance = {makeMap(MapKind::caustic), makeMap(MapKind::global)};
}

void MapRig::findImportance() {
  buildImportance(*stage_, parameters, importance.caustic, importance.global,
                  {plan.importons, plan.nearestImportons, features_.needsCausticMap});
}

void MapRig::seeGlobalMapDirectly() {
  importance.global = std::move(importance.caustic);
  parameters.globalMap.importonLevels = parameters.causticMap.importonLevels;
}

void MapRig::setImportance(const std::function<float(const vec3&)>& value) {
  std::vector<float> values;
  for (const MapPoint& site : importance.global.readPoints()) values.push_back(value(site.position));
  importance.global.importance.upload(std::span<const float>(values));
}

ImportonsFound MapRig::importons(MapKind kind) const {
  const ImportanceMap& map = kind == MapKind::caustic ? importance.caustic : importance.global;
  const std::uint64_t sites = (map.count + kImportonsPerSite - 1) / kImportonsPerSite;
  return {map.grid.points.download<MapPoint>(sites), map.importance.download<float>(sites)};
}

EmissionGuide MapRig::trainedGuide(const Scene& scene, MapKind kind, int bins) {
  EmissionGuide guide(context_, scene, kind, bins, GuideWeight::importance);
  const ImportanceMap& map = kind == MapKind::caustic ? importance.caustic : importance.global;
  const double pixels = static_cast<double>(parameters.width) * static_cast<double>(parameters.height);
  work_->parameters.upload(std::span<const Parameters>(&parameters, 1));
  recorder_->fill(work_->counters, 0);
  tracePhotons(*stage_, {kind, &guide}, 0, plan.batch, parameters.maxDepth);
  selectRecords(*stage_, recordMask(kind));
  guide.train(*stage_, map, static_cast<float>(pixels / surfaceArea(scene)));
  recorder_->submitAndWait();
  guide.update();
  return guide;
}

std::vector<EmittedPhoton> MapRig::emit(MapKind kind, const EmissionGuide* guide) {
  const uint plain = traitsOf(kind).randomStream;
  const buffers::Queue queue{work_->queueA};
  const kernels::PhotonEmit::Push push{0, plan.batch, guide ? guide->stream() : plain, guide ? guide->bins() : 0,
                                       kind == MapKind::global};
  work_->parameters.upload(std::span<const Parameters>(&parameters, 1));
  if (guide != nullptr)
    run<kernels::PhotonEmitGuided>(*stage_, plan.batch, push, queue, guide->buffers(stage_->work.standIns));
  else
    run<kernels::PhotonEmitByPower>(*stage_, plan.batch, push, queue);
  recorder_->submitAndWait();
  const auto rays = work_->rays.download<Ray>(plan.batch);
  const auto paths = work_->paths.download<PathState>(plan.batch);
  std::vector<EmittedPhoton> photons;
  for (std::size_t i = 0; i < rays.size(); ++i)
    photons.push_back({rays[i].direction, paths[i].source, paths[i].throughput});
  return photons;
}

ExpectedDensity MapRig::countPilot(MapKind kind) {
  ExpectedDensity expected(context_, kind, plan.capacityFor(kind));
  work_->parameters.upload(std::span<const Parameters>(&parameters, 1));
  recorder_->fill(work_->counters, 0);
  for (std::uint32_t first = 0; first < plan.whole.photonsFor(kind); first += plan.batch) {
    tracePhotons(*stage_, {kind, nullptr, true}, first, std::min(plan.batch, plan.whole.photonsFor(kind) - first),
                 parameters.maxDepth);
    selectRecords(*stage_, recordMask(kind));
    expected.count(*stage_, kind == MapKind::caustic ? importance.caustic : importance.global);
  }
  recorder_->submitAndWait();
  return expected;
}

PhotonMap MapRig::shoot(MapKind kind, const StorageRule& rule, std::uint64_t capacity) {
  PhotonMap map(context_, kind, capacity != 0 ? capacity : plan.capacityFor(kind));
  shootInto(map, kind, rule);
  return map;
}

void MapRig::shootInto(PhotonMap& map, MapKind kind, const StorageRule& rule) {
  const ImportanceMap& required = kind == MapKind::caustic ? importance.caustic : importance.global;
  work_->parameters.upload(std::span<const Parameters>(&parameters, 1));
  recorder_->fill(work_->counters, 0);
  map.begin(*stage_);
  for (std::uint32_t first = 0; first < plan.whole.photonsFor(kind); first += plan.batch) {
    tracePhotons(*stage_, {kind, nullptr}, first, std::min(plan.batch, plan.whole.photonsFor(kind) - first),
                 parameters.maxDepth);
    map.addBatch(*stage_, required, rule);
  }
  map.finish(*stage_, required, plan.nearestPhotons);
  recorder_->submitAndWait();
}

void MapRig::estimateIrradiance(PhotonMap& map, MapKind kind, bool atPhotons) {
  map.estimateIrradiance(*stage_, kind == MapKind::caustic ? importance.caustic : importance.global, atPhotons);
  recorder_->submitAndWait();
}

CellFlux MapRig::shootIntoCells(const SurfaceCells& cells) {
  parameters.irradianceUnits = parameters.fluxScale;
  parameters.photonUnits = 1 / (parameters.totalPower * parameters.irradianceUnits);
  IrradianceMap map(context_, cells, parameters.irradianceUnits, 0);
  work_->cells = map.cells(0);
  work_->parameters.upload(std::span<const Parameters>(&parameters, 1));
  recorder_->fill(work_->counters, 0);
  for (std::uint32_t first = 0; first < plan.whole.photons; first += plan.batch) {
    const std::uint32_t count = std::min(plan.batch, plan.whole.photons - first);
    tracePhotons(*stage_, {MapKind::global, nullptr}, first, count, parameters.maxDepth);
    map.addBatch(*stage_);
  }
  recorder_->submitAndWait();
  map.setPasses(1);
  CellFlux flux{{}, map.readFlux().isEnergyExact};
  const auto words = map.memory().front()->download<std::uint64_t>(8 * cells.areas.size());
  for (std::size_t at = 0; at < words.size(); at += 4) flux.sides.push_back({words[at], words[at + 1], words[at + 2]});
  return flux;
}

std::vector<MapPoint> MapRig::photons(const PhotonMap& map) const { return map.readPoints(*stage_); }

std::vector<MapPoint> MapRig::photonsAsStored(const PhotonMap& map) const {
  const std::vector<MapPoint> inCells = photons(map);
  const auto order = map.finished().storedOrder.download<uint>(inCells.size());
  std::vector<MapPoint> stored(inCells.size());
  for (std::size_t i = 0; i < order.size(); ++i) stored[order[i]] = inCells[i];
  return stored;
}

namespace {

/// Lib/flux.glsl's unpackFlux.
vec3 unpackFlux(uvec2 p) {
  const uvec3 bits(p.x & 0x1FFFFFu, (p.x >> 21) | ((p.y & 0x3FFu) << 11), p.y >> 10);
  return vec3(std::bit_cast<float>(bits.x << 10), std::bit_cast<float>(bits.y << 10),
              std::bit_cast<float>(bits.z << 10));
}

}  // namespace

std::vector<vec3> MapRig::flux(const PhotonMap& map) const {
  std::vector<vec3> flux;
  for (const uvec2 packed : map.finished().mapFlux.download<uvec2>(counts(map).stored))
    flux.push_back(unpackFlux(packed));
  return flux;
}

std::vector<float> MapRig::aovs(const PhotonMap& global) {
  const uint pixels = parameters.width * parameters.height;
  const gpu::Buffer buffer(context_, "AOVs", std::uint64_t{pixels} * kAovFloats * sizeof(float));
  EyeMaps maps{&importance.caustic, &importance.global};
  maps.see(MapKind::global, global);
  traceAovs(*stage_, maps, 0, pixels, buffer);
  recorder_->submitAndWait();
  return buffer.download<float>(std::uint64_t{pixels} * kAovFloats);
}

}  // namespace importon::test
