#include "render/render_session.h"

#include <cmath>
#include <stdexcept>
#include <future>

#include "accel/bvh.h"
#include "base/error.h"
#include "fmt/format.h"
#include "render/aov_image.h"
#include "render/error_estimate.h"
#include "render/features.h"
#include "render/photon_pass.h"
#include "shared/bindings.h"
#include "shared/ray_data.h"

namespace importon {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

constexpr int kCausticBins = 128, kGlobalBins = 16;  // of a guide, along both axes of a light's unit square
constexpr std::uint32_t kPilotPhotons = 1u << 14;  // show where photons fall
constexpr double kFloorPhotonsPerCell = 2;           // of the density floor, for the largest cells
constexpr double kLeastGain = 1.5;                  // learned, from which on global photons are guided

/// m², of one side.
double surfaceArea(const Scene& scene) {
  double area = 0;
  for (const Triangle& t : scene.triangles)
    area += 0.5 * glm::length(glm::cross(scene.positions[t.v1] - scene.positions[t.v0],
                                         scene.positions[t.v2] - scene.positions[t.v0]));
  return area;
}

/// Builds the BVH; a progress line when it takes long.
Bvh buildSceneBvh(const Scene& scene, const RenderJob& job, Log& log, double& seconds) {
  const Clock::time_point start = Clock::now();
  const auto progress = [&](double fraction) {
    if (secondsSince(start) > 1) log.progress(fmt::format("building the BVH: {:.0f} %", 100 * fraction));
  };
  Bvh bvh = buildBvh(scene.positions, scene.triangles, {job.threads, progress});
  log.endProgress();
  seconds = secondsSince(start);
  return bvh;
}

}  // namespace

RenderSession::RenderSession(const RenderJob& job, const Scene& scene, Log& log)
    : job_(job), scene_(scene), log_(log), control_(job.control) {
  size_ = chooseSize(chooseCamera(scene, job), job);
  features_ = findFeatures(scene, job);
  // The device and its kernels come up while the tree is built.
  auto device = std::async(std::launch::async, [this] { loadDevice(); });
  const Bvh bvh = buildSceneBvh(scene, job, log, stats_.seconds.bvh);
  device.get();
  const Clock::time_point start = Clock::now();
  deviceScene_ = uploadScene(*context_, scene, bvh);
  surfaceArea_ = surfaceArea(scene);
  plan_ = planPasses(job, features_, size_, context_->limits());
  parameters_ = makeParameters(job, scene, plan_, size_);
  work_.emplace(*context_, plan_.workspace);
  deviceScene_.bind(work_->table);
  recorder_.emplace(*context_);
  stage_.emplace(Stage{*context_, *recorder_, kernels_, *work_});
  film_.emplace(*context_, static_cast<std::uint64_t>(size_.x) * static_cast<std::uint64_t>(size_.y), plan_.tilePixels);
  importance_ = makeImportanceMaps(*context_, plan_.importons * (std::uint64_t{parameters_.maxDepth} + 1),
                                   plan_.workspace.hasDifferentials);
  if (hasMaps()) {
    if (!features_.readsCells)
      globalMap_.emplace(*context_, MapKind::global, plan_.mapCapacity, plan_.workspace.records);
    if (features_.needsCausticMap)
      causticMap_.emplace(*context_, MapKind::caustic, plan_.mapCapacity, plan_.workspace.records);
  }
  stats_.seconds.device += secondsSince(start);
}

void RenderSession::loadDevice() {
  const Clock::time_point start = Clock::now();
  context_ = std::make_unique<gpu::Context>(gpu::ContextOptions{job_.device, job_.validation});
  kernels_ = makeKernels(*context_, features_, job_);
  stats_.seconds.device = secondsSince(start);
}

void RenderSession::findImportance() {
  const Clock::time_point start = Clock::now();
  buildImportance(*stage_, parameters_, importance_, plan_.importons, plan_.nearestImportons,
                  causticMap_.has_value());
  // A camera that sees no surface to light needs no photons, nor does a scene that has no light to shoot them.
  if (scene_.lights.empty() || (importance_.global.count == 0 && importance_.caustic.count == 0)) plan_.photons = 0;
  std::optional<PointDensity> importance;
  if (features_.readsCells) importance = densityOfRecords(1, true);
  trainGuides();
  shootPilot();
  if (features_.readsCells) makeIrradianceMap(importance);
  stats_.importonsEmitted = plan_.importons;
  stats_.importonsCaustic = importance_.caustic.count;
  stats_.importonsGlobal = importance_.global.count;
  stats_.seconds.importance = secondsSince(start);
}

float RenderSession::meanImportance() const {
  return static_cast<float>(size_.x) * static_cast<float>(size_.y) / static_cast<float>(surfaceArea_);
}

void RenderSession::trainGuides() {
  if (job_.emission == EmissionChoice::power || plan_.photons == 0) return;
  startPass(0);
  const auto train = [&](std::optional<EmissionGuide>& guide, MapKind kind, const ImportanceMap& importance, int bins) {
    guide.emplace(*context_, scene_, kind, bins);
    tracePhotons(*stage_, {kind, &*guide}, 0, std::min(plan_.batch, plan_.photons), parameters_.maxDepth);
    selectRecords(*stage_, recordMask(kind));
    guide->learn(*stage_, importance, meanImportance());
    recorder_->submitAndWait();
    guide->update();
  };
  train(globalGuide_, MapKind::global, importance_.global, kGlobalBins);
  if (job_.emission == EmissionChoice::automatic && globalGuide_->gain() < kLeastGain) globalGuide_.reset();
  if (causticMap_) train(causticGuide_, MapKind::caustic, importance_.caustic, kCausticBins);
}

void RenderSession::shootPilot() {
  if (control_ != DensityControl::probability) return;
  startPass(0);
  const auto count = [&](std::optional<ExpectedDensity>& expected, MapKind kind, const ImportanceMap& importance,
                         const std::optional<EmissionGuide>& guide) {
    expected.emplace(*context_, kind, plan_.mapCapacity);
    for (std::uint32_t first = 0; first < plan_.photons; first += plan_.batch) {
      tracePhotons(*stage_, {kind, guide ? &*guide : nullptr, true}, first,
                   std::min(plan_.batch, plan_.photons - first), parameters_.maxDepth);
      expected->count(*stage_, importance);
    }
    recorder_->submitAndWait();
  };
  count(globalExpected_, MapKind::global, importance_.global, globalGuide_);
  if (causticMap_) count(causticExpected_, MapKind::caustic, importance_.caustic, causticGuide_);
}

StorageRule RenderSession::storageRule(MapKind kind) const {
  const std::optional<ExpectedDensity>& expected = kind == MapKind::global ? globalExpected_ : causticExpected_;
  return {control_, plan_.receivers, expected ? &*expected : nullptr, static_cast<float>(job_.probabilityFloor)};
}

void RenderSession::makeIrradianceMap(const std::optional<PointDensity>& importance) {
  startPass(0);
  const std::uint32_t pilot = std::min({plan_.batch, plan_.photons, kPilotPhotons});
  if (pilot > 0) tracePhotons(*stage_, {MapKind::global, nullptr, true}, 0, pilot, parameters_.maxDepth);
  recorder_->submitAndWait();
  const std::optional<PointDensity> hits =
      densityOfRecords(static_cast<float>(plan_.photons) / static_cast<float>(std::max(pilot, 1u)), false);
  const double floor = parameters_.globalMap.densityFloor / kFloorPhotonsPerCell;
  const double constant = static_cast<double>(parameters_.globalMap.constantDensity);
  const auto density = [&](vec3 position) {
    if (constant > 0) return constant;
    const double required = importance->at(position) * static_cast<double>(parameters_.globalMap.photonsPerPixel);
    return std::max(floor, std::min(required, hits->at(position)));
  };
  const SurfaceCells cells = cutSurfaces(scene_, density, plan_.mostCells, job_.threads);
  constexpr float kPasses = 1u << 20;  // that the sums have room for
  parameters_.irradianceUnits = parameters_.fluxScale / kPasses;
  irradiance_.emplace(*context_, cells, plan_.workspace.records, parameters_.irradianceUnits);
}

void RenderSession::updateGuides() {
  for (std::optional<EmissionGuide>* guide : {&globalGuide_, &causticGuide_})
    if (*guide) (*guide)->update();
}

std::optional<PointDensity> RenderSession::densityOfRecords(float scale, bool isFlux) const {
  const uint count = work_->counters.download<uint>(1, kCounterRecords * sizeof(uint)).front();
  const auto points = work_->recordPoints.download<MapPoint>(count);
  const auto records = work_->records.download<Record>(count);
  std::vector<vec3> positions;
  std::vector<float> weights;
  for (std::size_t i = 0; i < count; ++i) {
    if ((records[i].kind & kRecordGlobal) == 0) continue;
    positions.push_back(points[i].position);
    weights.push_back(scale * (isFlux ? records[i].flux.x : 1.0f));
  }
  return PointDensity(positions, weights, parameters_.gridOrigin, parameters_.gridExtent);
}

void RenderSession::startPass(int pass) {
  parameters_.pass = static_cast<uint>(pass);
  parameters_.densityScale = std::cbrt(static_cast<float>(pass + 1));  // r² shrinks as its inverse
  if (irradiance_) {
    parameters_.irradianceScale = irradiance_->scale(pass);
    irradiance_->bind(work_->table, pass);
  }
  uploadParameters();
  recorder_->fill(work_->counters, 0);
}

void RenderSession::uploadParameters() {
  work_->parameters.upload(std::span<const Parameters>(&parameters_, 1));
}

void RenderSession::shootPhotons(int pass) {
  startPass(pass);
  if (!hasMaps()) return;
  const Clock::time_point start = Clock::now();
  if (irradiance_) fillCells(pass);
  fillMaps();
  while (isMapFull()) {
    controlHarder();
    uploadParameters();
    fillMaps();
  }
  if (pass < kLearningPasses) updateGuides();
  stats_.seconds.photons += secondsSince(start);
}

bool RenderSession::isMapFull() const {
  const auto counters = work_->counters.download<uint>(kCounterCount);
  return (globalMap_ && globalMap_->overflow(counters) > 0) || (causticMap_ && causticMap_->overflow(counters) > 0);
}

void RenderSession::controlHarder() {
  const double first = 4 * static_cast<double>(plan_.mapCapacity) / surfaceArea_;
  const float limit = std::min(0.5f * parameters_.globalMap.densityLimit, static_cast<float>(first));
  if (limit * surfaceArea_ < 1)
    throw DeviceError("the photon maps", fmt::format("no room for {} photons", plan_.mapCapacity), "raise --memory");
  parameters_.globalMap.densityLimit = parameters_.causticMap.densityLimit = limit;
  control_ = DensityControl::density;
  log_.warn("photon map full", "the photon maps need more than --memory allows: fewer photons are stored than "
                               "required, each with more power");
}

void RenderSession::shootBatches(MapKind kind, std::optional<EmissionGuide>& guide,
                                 const std::function<void()>& takeBatch) {
  const ImportanceMap& importance = kind == MapKind::global ? importance_.global : importance_.caustic;
  const bool isLearning = guide && static_cast<int>(parameters_.pass) < kLearningPasses;
  for (std::uint32_t first = 0; first < plan_.photons; first += plan_.batch) {
    tracePhotons(*stage_, {kind, guide ? &*guide : nullptr}, first, std::min(plan_.batch, plan_.photons - first),
                 parameters_.maxDepth);
    takeBatch();
    if (isLearning) guide->learn(*stage_, importance, meanImportance());
  }
}

void RenderSession::fillCells(int pass) {
  shootBatches(MapKind::global, globalGuide_, [&] {
    irradiance_->addBatch(*stage_);
    if (globalGuide_) selectRecords(*stage_, recordMask(MapKind::global));  // what it learns from
  });
  irradiance_->setPasses(pass + 1);
}

void RenderSession::fillMaps() {
  if (globalMap_) fillMap(*globalMap_, MapKind::global, importance_.global, globalGuide_);
  if (causticMap_) fillMap(*causticMap_, MapKind::caustic, importance_.caustic, causticGuide_);
  recorder_->submitAndWait();
}

void RenderSession::fillMap(PhotonMap& map, MapKind kind, const ImportanceMap& importance,
                            std::optional<EmissionGuide>& guide) {
  map.begin(*stage_);
  shootBatches(kind, guide, [&] { map.addBatch(*stage_, importance, storageRule(kind)); });
  map.finish(*stage_, importance);
}

EyeMaps RenderSession::eyeMaps() const {
  EyeMaps maps;
  maps.importance = &importance_;  // bound also where nothing reads it
  if (!hasMaps()) return maps;
  maps.global = globalMap_ ? &*globalMap_ : nullptr;
  maps.hasCells = irradiance_.has_value();
  maps.caustic = causticMap_ ? &*causticMap_ : nullptr;
  return maps;
}

void RenderSession::gatherImage(int pass) {
  const Clock::time_point start = Clock::now();
  for (const FilmTile& tile : film_->tiles()) {
    const uint half = pass % 2 == 0 ? 0 : tile.count;
    for (uint sample = 0; sample < plan_.samples; ++sample)
      traceImage(*stage_, eyeMaps(), sample, tile.first, tile.count, parameters_.maxDepth, tile.pixels, half);
  }
  recorder_->submitAndWait();
  stats_.seconds.gather += secondsSince(start);
}

void RenderSession::addCounts(PhotonMapStats& stats, const PhotonMapCounts& counts, const char* map) {
  stats.hits += counts.hits;
  stats.stored += counts.stored;
  stats.redistributed += counts.redistributed;
  stats.fluxHits = counts.fluxHits;
  stats.fluxMap = counts.fluxMap;
  if (!counts.isEnergyExact)
    throw std::logic_error(fmt::format("the {} map does not hold the power of its hits", map));
}

void RenderSession::countPass(int) {
  const auto counters = work_->counters.download<uint>(kCounterCount);
  stats_.closestRays += counters[kCounterRaysClosest];
  stats_.shadowRays += counters[kCounterRaysShadow];
  if (counters[kCounterTraceUnfinished] > 0)
    log_.warn("rays given up", fmt::format("{} rays were too long for this device", counters[kCounterTraceUnfinished]));
  if (!hasMaps()) return;
  stats_.photonsEmitted += plan_.photons * (causticMap_ ? 2u : 1u);
  if (globalMap_) addCounts(stats_.global, globalMap_->readCounts(*stage_, parameters_.fluxScale), "global");
  if (irradiance_) {
    const uint first = kCounterMap + kCountersPerMap * static_cast<uint>(MapKind::global);
    stats_.global.hits += counters[first + kMapHits];
    stats_.global.stored += counters[first + kMapStored];
    stats_.global.redistributed += counters[first + kMapHits] - counters[first + kMapStored];
  }
  if (causticMap_) addCounts(stats_.caustic, causticMap_->readCounts(*stage_, parameters_.fluxScale), "caustic");
}

FilmLayers RenderSession::readFilm(int passes) const {
  return resolveFilm(film_->download(), {size_.x, passes, static_cast<int>(plan_.samples),
                                         job_.filtersIndirect && hasMaps(), job_.threads});
}

Image RenderSession::resolve(int passes) {
  const FilmLayers layers = readFilm(passes);
  if (passes >= 2) {
    stats_.error.estimated = layers.estimatedError;
    stats_.error.low = kBandLow * layers.estimatedError;
    stats_.error.high = kBandHigh * layers.estimatedError;
  }
  Image image;
  image.width = size_.x;
  image.height = size_.y;
  addColor(image, "", layers.total);
  addAovs(image, layers);
  return image;
}

Image RenderSession::resolveColor(int passes) const {
  Image image{size_.x, size_.y, {}, {}};
  addColor(image, "", readFilm(passes).total);
  return image;
}

void RenderSession::addAovs(Image& image, const FilmLayers& layers) {
  if (job_.aovs.empty()) return;
  std::vector<float> values(layers.total.size() * kAovFloats);
  for (const FilmTile& tile : film_->tiles()) {
    const gpu::Buffer buffer(*context_, "AOVs", std::uint64_t{tile.count} * kAovFloats * sizeof(float));
    traceAovs(*stage_, eyeMaps(), tile.first, tile.count, buffer);
    recorder_->submitAndWait();
    buffer.downloadBytes(std::as_writable_bytes(
        std::span(values).subspan(std::size_t{tile.first} * kAovFloats, std::size_t{tile.count} * kAovFloats)));
  }
  addAovLayers(image, job_.aovs, layers, values, scene_.worldFromRender);
}

void RenderSession::finishStats(int passes) {
  stats_.deviceName = context_->info().name;
  stats_.deviceDriver = context_->info().driver;
  stats_.deviceType = context_->info().type;
  stats_.triangles = scene_.triangles.size();
  stats_.lights = scene_.lights.size();
  for (const FeatureRow& row : describeFeatures(scene_, job_))
    if (row.isModelled) stats_.features.push_back(row.name);
  stats_.width = size_.x;
  stats_.height = size_.y;
  stats_.passes = passes;
  stats_.devicePeakBytes = context_->peakBytes();
  for (const std::string& message : context_->takeValidationMessages()) log_.warn("validation", message);
  for (const std::optional<PhotonMap>* map : {&globalMap_, &causticMap_})
    if (*map) stats_.photonMapBytes += (*map)->bytes();
  if (irradiance_) {
    stats_.photonMapBytes += irradiance_->bytes();
    addCounts(stats_.global, irradiance_->readFlux(), "global");
  }
  for (const gpu::KernelTime& t : recorder_->times())
    stats_.kernels.push_back({t.label, t.launches, t.milliseconds});
}

}  // namespace importon
