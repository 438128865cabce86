#include "render/render_session.h"

#include <cmath>
#include <future>
#include <stdexcept>

#include "accel/bvh.h"
#include "base/clock.h"
#include "base/error.h"
#include "fmt/format.h"
#include "render/aov_image.h"
#include "render/error_estimate.h"
#include "render/features.h"
#include "render/gather_source.h"
#include "render/photon_pass.h"
#include "render/point_layer.h"
#include "shared/bindings.h"
#include "shared/push_data.h"
#include "shared/ray_data.h"

namespace importon {
namespace {

/// Low word in x.
uvec2 wordsOf(std::uint64_t n) { return {static_cast<uint>(n), static_cast<uint>(n >> 32)}; }

/// Of the variance of indirect light, if the filter shares it among pixels.
constexpr float kFilteredShare = 1.0f / 128;

bool isPointLayer(const std::string& name) { return name.starts_with("importons.") || name.starts_with("photons."); }

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

RenderSession::RenderSession(const RenderJob& job, const Scene& scene, Log& log, const DeviceSource& deviceSource)
    : job_(job), scene_(scene), log_(log), control_(job.control) {
  size_ = chooseSize(chooseCamera(scene, job), job);
  samplePlan_ = SamplePlan(size_.x, pixels());
  features_ = findFeatures(scene, job);
  // The device and its kernels come up while the tree is built.
  auto loading = std::async(std::launch::async, [&] {
    const Clock::time_point start = Clock::now();
    device_ = deviceSource(features_, job);
    stats_.seconds.device = secondsSince(start);
  });
  const Bvh bvh = buildSceneBvh(scene, job, log, stats_.seconds.bvh);
  loading.get();
  const Clock::time_point start = Clock::now();
  deviceScene_ = uploadScene(device_->context, scene, bvh);
  surfaceArea_ = surfaceArea(scene);
  plan_ = planPasses(job, features_, size_, device_->context.limits());
  now_ = plan_.whole;
  parameters_ = makeParameters(job, scene, plan_, size_);
  work_.emplace(device_->context, plan_.workspace);
  deviceScene_.bind(work_->table);
  recorder_.emplace(device_->context);
  stage_.emplace(Stage{device_->context, *recorder_, device_->kernels, *work_});
  film_.emplace(device_->context, static_cast<std::uint64_t>(size_.x) * static_cast<std::uint64_t>(size_.y), plan_.tilePixels);
  importance_ = makeImportanceMaps(device_->context, plan_.importons * (std::uint64_t{parameters_.maxDepth} + 1),
                                   plan_.workspace.hasDifferentials);
  if (hasMaps()) {
    if (!features_.readsCells) globalMap_.emplace(device_->context, MapKind::global, plan_.mapCapacity);
    if (features_.needsCausticMap)
      causticMap_.emplace(device_->context, MapKind::caustic, plan_.causticCapacity);
  }
  stats_.seconds.device += secondsSince(start);
}

void RenderSession::findImportance() {
  const Clock::time_point start = Clock::now();
  buildImportance(*stage_, parameters_, importance_, plan_.importons, plan_.nearestImportons,
                  causticMap_.has_value());
  // A camera that sees no surface to light needs no photons, nor does a scene that has no light to shoot them.
  if (scene_.lights.empty() || (importance_.global.count == 0 && importance_.caustic.count == 0))
    now_.photons = now_.causticPhotons = plan_.whole.photons = plan_.whole.causticPhotons = 0;
  if (features_.readsCells) cellSizes_.emplace(densityOfRecords(1, true));
  knowOtherLight();
  trainGuides();
  findEnoughPhotons();
  expectDensity();
  chooseLookups(MapKind::global, parameters_.globalMap);
  chooseLookups(MapKind::caustic, parameters_.causticMap);
  countCausticHits();
  if (features_.readsCells) findCellSizes();
  stats_.importonsEmitted = plan_.importons;
  stats_.importonsCaustic = importance_.caustic.count;
  stats_.importonsGlobal = importance_.global.count;
  stats_.seconds.importance = secondsSince(start);
}

float RenderSession::meanImportance() const {
  return static_cast<float>(size_.x) * static_cast<float>(size_.y) / static_cast<float>(surfaceArea_);
}

StorageRule RenderSession::storageRule(MapKind kind) const {
  const std::optional<ExpectedDensity>& expected = kind == MapKind::global ? globalExpected_ : causticExpected_;
  StorageRule rule = plan_.storage;
  rule.control = control_;
  rule.expected = expected ? &*expected : nullptr;
  return rule;
}

void RenderSession::updateGuides() {
  for (std::optional<EmissionGuide>* guide : {&globalGuide_, &causticGuide_})
    if (*guide) (*guide)->update();
}

void RenderSession::startPass(int pass) {
  parameters_.pass = static_cast<uint>(pass);
  parameters_.densityScale = std::cbrt(static_cast<float>(pass + 1));  // r² shrinks as its inverse
  parameters_.firstSample = wordsOf(done_.evenSamples + done_.oddSamples);
  setPhotons(parameters_.globalMap, now_.photons, done_.photons, done_.photonsCounted);
  setPhotons(parameters_.causticMap, now_.causticPhotons, done_.causticPhotons, done_.causticCounted);
  if (features_.readsCells && cellSizes_->hits) prepareCells(pass);
  uploadParameters();
  recorder_->fill(work_->counters, 0);
}

void RenderSession::setPhotons(MapSettings& map, std::uint32_t perPass, std::uint64_t before, std::uint64_t counted) const {
  map.photonsPerPass = perPass;
  map.firstPhoton = wordsOf(before);
  map.photonsCounted = 0;
  if (counted == 0 || perPass == 0) return;
  const std::uint64_t now = parameters_.pass < kCountingPasses ? perPass : 0;
  map.photonsCounted = static_cast<float>(static_cast<double>(counted + now) / perPass);
}

void RenderSession::uploadParameters() {
  work_->parameters.upload(std::span<const Parameters>(&parameters_, 1));
}

void RenderSession::shootPhotons(int pass, int parts) {
  now_ = plan_.sizeOf(parts);
  startPass(pass);
  if (!hasMaps()) return;
  const Clock::time_point start = Clock::now();
  const auto shoot = [&](bool isFirst) {
    shootFor(MapKind::global, isFirst);
    shootFor(MapKind::caustic, isFirst);
    recorder_->submitAndWait();
  };
  shoot(true);
  while (isMapFull()) {
    controlHarder();
    uploadParameters();
    shoot(false);
  }
  if (irradiance_) irradiance_->setPasses(pass + 1);
  if (pass < kLearningPasses) updateGuides();
  stats_.seconds.photons += secondsSince(start);
}

bool RenderSession::isMapFull() const {
  const auto counters = work_->counters.download<uint>(kCounterCount);
  return (globalMap_ && globalMap_->overflow(counters) > 0) || (causticMap_ && causticMap_->overflow(counters) > 0);
}

void RenderSession::controlHarder() {
  const std::uint64_t mostPhotons = std::max(plan_.mapCapacity, plan_.causticCapacity);
  const double first = 4 * static_cast<double>(mostPhotons) / surfaceArea_;
  const float limit = std::min(0.5f * parameters_.globalMap.densityLimit, static_cast<float>(first));
  if (limit * surfaceArea_ < 1)
    throw DeviceError("the photon maps", fmt::format("no room for {} photons", mostPhotons), "raise --memory");
  parameters_.globalMap.densityLimit = parameters_.causticMap.densityLimit = limit;
  control_ = DensityControl::density;
  log_.warn("photon map full", "the photon maps need more than --memory allows: fewer photons are stored than "
                               "required, each with more power");
}

void RenderSession::shootFor(MapKind kind, bool isFirst) {
  const bool isGlobal = kind == MapKind::global;
  std::optional<PhotonMap>& map = isGlobal ? globalMap_ : causticMap_;
  const bool fillsCells = isGlobal && irradiance_ && isFirst;
  if (!map && !fillsCells) return;
  const ImportanceMap& importance = isGlobal ? importance_.global : importance_.caustic;
  EmissionGuide* guide = guideFor(kind);
  const bool isLearning = guide && isFirst && static_cast<int>(parameters_.pass) < kLearningPasses;
  if (map) map->begin(*stage_);
  const std::uint32_t photons = now_.photonsFor(kind);
  for (std::uint32_t first = 0; first < photons; first += plan_.batch) {
    tracePhotons(*stage_, sourceOf(kind, false), first, std::min(plan_.batch, photons - first), parameters_.maxDepth);
    if (fillsCells) irradiance_->addBatch(*stage_);
    if (map) map->addBatch(*stage_, importance, storageRule(kind));
    else if (isLearning) selectRecords(*stage_, recordMask(kind));
    if (isLearning) guide->learn(*stage_, importance, meanImportance());
  }
  if (fillsCells) irradiance_->smooth(*stage_);
  if (!map) return;
  map->finish(*stage_, importance, plan_.nearestPhotons);
  if (isGlobal && job_.irradiance != IrradianceCache::off)
    map->estimateIrradiance(*stage_, importance, job_.irradiance == IrradianceCache::photons);
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
  if (plan_.isAdaptive && SamplePlan::learnsBefore(pass))
    samplePlan_.learn(film_->download(), done_.evenSamples, done_.oddSamples, job_.filtersIndirect ? kFilteredShare : 1.0f);
  for (FilmTile& tile : film_->tiles()) {
    const auto trace = [&](const EyeSamples& samples) {
      traceImage(*stage_, eyeMaps(), samples, tile.first, tile.count, parameters_.maxDepth, tile.pixels,
                 pass % 2 == 0 ? 0 : tile.count);
    };
    if (samplePlan_.hasLearned()) {
      const std::vector<uvec2> dealt = samplePlan_.deal(pass, now_.samples, tile.first, tile.count);
      tile.plan = gpu::makeBuffer(device_->context, "sample plan", std::span<const uvec2>(dealt), gpu::TexelFormat::uint2);
      const uint paths = dealt.back().x, most = tile.count * plan_.samplesAtOnce;
      for (uint first = 0; first < paths; first += most) trace({first, std::min(most, paths - first), &tile.plan});
      continue;
    }
    for (uint first = 0; first < now_.samples; first += plan_.samplesAtOnce)
      trace({first, std::min(plan_.samplesAtOnce, now_.samples - first)});
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

void RenderSession::addToDone(int pass) {
  (pass % 2 == 0 ? done_.evenSamples : done_.oddSamples) += now_.samples;
  done_.photons += now_.photons;
  done_.causticPhotons += now_.causticPhotons;
  if (parameters_.pass >= kCountingPasses) return;
  done_.photonsCounted += now_.photons;
  done_.causticCounted += now_.causticPhotons;
}

void RenderSession::countPass(int pass) {
  addToDone(pass);
  const auto counters = work_->counters.download<uint>(kCounterCount);
  stats_.closestRays += sumOf(counters, kSumRaysClosest);
  stats_.shadowRays += sumOf(counters, kSumRaysShadow);
  if (counters[kCounterTraceUnfinished] > 0)
    log_.warn("rays given up", fmt::format("{} rays were too long for this device", counters[kCounterTraceUnfinished]));
  if (counters[kCounterLookupsUnfinished] > 0)
    log_.warn("lookups given up", fmt::format("{} lookups of the nearest photons were too long for this device",
                                              counters[kCounterLookupsUnfinished]));
  if (!hasMaps()) return;
  stats_.global.emitted += now_.photons;
  if (causticMap_) stats_.caustic.emitted += now_.causticPhotons;
  stats_.photonsEmitted = stats_.global.emitted + stats_.caustic.emitted;
  if (globalMap_) addCounts(stats_.global, globalMap_->readCounts(*stage_, parameters_.fluxScale), "global");
  else if (irradiance_) {
    stats_.global.hits += sumOf(counters, kSumCellHits);
    stats_.global.stored += counters[kCounterCellsLit];
    stats_.global.redistributed += sumOf(counters, kSumCellHits) - counters[kCounterCellsLit];
  }
  if (causticMap_) addCounts(stats_.caustic, causticMap_->readCounts(*stage_, parameters_.fluxScale), "caustic");
}

FilmLayers RenderSession::readFilm() const {
  return resolveFilm(film_->download(), {size_.x, samplePlan_.counts(done_.evenSamples, done_.oddSamples),
                                         job_.filtersIndirect && hasMaps(), job_.threads});
}

Image RenderSession::resolve() {
  const FilmLayers layers = readFilm();
  if (done_.oddSamples > 0) {
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

Image RenderSession::resolveColor() const {
  Image image{size_.x, size_.y, {}, {}};
  addColor(image, "", readFilm().total);
  return image;
}

void RenderSession::addAovs(Image& image, const FilmLayers& layers) {
  if (job_.aovs.empty()) return;
  std::vector<float> values(layers.total.size() * kAovFloats);
  for (const FilmTile& tile : film_->tiles()) {
    const gpu::Buffer buffer(device_->context, "AOVs", std::uint64_t{tile.count} * kAovFloats * sizeof(float));
    traceAovs(*stage_, eyeMaps(), tile.first, tile.count, buffer);
    recorder_->submitAndWait();
    buffer.downloadBytes(std::as_writable_bytes(
        std::span(values).subspan(std::size_t{tile.first} * kAovFloats, std::size_t{tile.count} * kAovFloats)));
  }
  std::vector<std::string> others;
  for (const std::string& name : job_.aovs) {
    if (isPointLayer(name)) image.channels.push_back({name + ".Y", pointLayer(name, values)});
    else others.push_back(name);
  }
  addAovLayers(image, others, layers, values, scene_.worldFromRender);
}

std::vector<float> RenderSession::pointLayer(const std::string& name, std::span<const float> aovs) const {
  const bool isGlobal = name.ends_with("global");
  const std::optional<PhotonMap>& map = isGlobal ? globalMap_ : causticMap_;
  if (!map) return std::vector<float>(pixels());
  if (name.starts_with("photons")) return countPoints(map->readPoints(*stage_), 1, parameters_, aovs);
  const ImportanceMap& importons = isGlobal ? importance_.global : importance_.caustic;
  return countPoints(importons.readPoints(), static_cast<float>(kImportonsPerSite), parameters_, aovs);
}

void RenderSession::finishStats(int passes) {
  stats_.deviceName = device_->context.info().name;
  stats_.deviceDriver = device_->context.info().driver;
  stats_.deviceType = device_->context.info().type;
  stats_.triangles = scene_.triangles.size();
  stats_.lights = scene_.lights.size();
  for (const FeatureRow& row : describeFeatures(scene_, job_))
    if (row.isModelled) stats_.features.push_back(row.name);
  stats_.gatherFrom = gatherSourceName(job_);
  stats_.width = size_.x;
  stats_.height = size_.y;
  stats_.passes = passes;
  stats_.devicePeakBytes = device_->context.peakBytes();
  for (const std::string& message : device_->context.takeValidationMessages()) log_.warn("validation", message);
  for (const std::optional<PhotonMap>* map : {&globalMap_, &causticMap_})
    if (*map) stats_.photonMapBytes += (*map)->bytes();
  for (const std::optional<ExpectedDensity>* expected : {&globalExpected_, &causticExpected_})
    if (*expected) stats_.photonMapBytes += (*expected)->bytes();
  if (irradiance_) {
    stats_.photonMapBytes += irradiance_->bytes();
    if (!globalMap_) addCounts(stats_.global, irradiance_->readFlux(), "global");
  }
  for (const gpu::KernelTime& t : recorder_->times())
    stats_.kernels.push_back({t.label, t.launches, t.milliseconds});
}

}  // namespace importon
