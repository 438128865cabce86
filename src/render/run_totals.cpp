#include "render/run_totals.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <string>

#include "render/features/feature_set.h"
#include "render/options/gather_source.h"
#include "scene/studio.h"
#include "shared/ray_data.h"

namespace importon {
namespace {

void addCounts(PhotonMapStats& stats, const PhotonMapCounts& counts, MapKind kind) {
  stats.hits += counts.hits;
  stats.stored += counts.stored;
  stats.redistributed += counts.redistributed;
  stats.fluxHits = counts.fluxHits;
  stats.fluxMap = counts.fluxMap;
  if (!counts.isEnergyExact)
    throw std::logic_error(fmt::format("the {} map does not hold the power of its hits", traitsOf(kind).name));
}

void addMap(PhotonMapStats& sum, const PhotonMapStats& other) {
  sum.emitted += other.emitted;
  sum.hits += other.hits;
  sum.stored += other.stored;
  sum.redistributed += other.redistributed;
  for (std::size_t c = 0; c < sum.fluxHits.size(); ++c) {
    sum.fluxHits[c] += other.fluxHits[c];
    sum.fluxMap[c] += other.fluxMap[c];
  }
}

void addKernels(std::vector<KernelStats>& sum, const std::vector<KernelStats>& other) {
  for (const KernelStats& kernel : other) {
    const auto found = std::ranges::find(sum, kernel.label, &KernelStats::label);
    if (found == sum.end()) {
      sum.push_back(kernel);
      continue;
    }
    found->launches += kernel.launches;
    found->milliseconds += kernel.milliseconds;
    found->compileMilliseconds += kernel.compileMilliseconds;
  }
}

constexpr std::array kSums{
    &RenderStats::closestRays,      &RenderStats::shadowRays,      &RenderStats::importonsEmitted,
    &RenderStats::importonsCaustic, &RenderStats::importonsGlobal, &RenderStats::photonsEmitted,
    &RenderStats::photonsPilot,     &RenderStats::devicePeakBytes, &RenderStats::photonMapBytes};
constexpr std::array kMeans{&PhaseSeconds::importance, &PhaseSeconds::cells, &PhaseSeconds::photons,
                            &PhaseSeconds::gather};

void checkUnfinished(std::span<const uint> counters, Log& log) {
  if (counters[kCounterTraceUnfinished] > 0)
    log.warn("rays given up", fmt::format("{} rays were too long for this device", counters[kCounterTraceUnfinished]));
  checkLookups(counters[kCounterLookupsUnfinished]);
  if (counters[kCounterMediaForgotten] > 0)
    log.warn("solids in solids", fmt::format("{} times a path was in more than {} solids at once; the outermost was "
                                             "left out of account",
                                             counters[kCounterMediaForgotten], kMostMediaAtOnce));
}

}  // namespace

void RunTotals::addToDone(int pass) {
  const PassSize& now = context_.now;
  (pass % 2 == 0 ? done_.evenSamples : done_.oddSamples) += now.samples;
  for (const MapKind kind : kMapKinds) {
    done_.of(kind).shot += now.photonsFor(kind);
    if (context_.parameters.pass < kCountingPasses) done_.of(kind).counted += now.photonsFor(kind);
  }
}

void RunTotals::countPass(int pass, const PhotonSystem& caustic, const PhotonSystem& global,
                          const SurfaceCache& cache) {
  addToDone(pass);
  RenderStats& stats = context_.stats;
  const auto counters = context_.work.counters.download<uint>(kCounterCount);
  stats.closestRays += sumOf(counters, kSumRaysClosest);
  stats.shadowRays += sumOf(counters, kSumRaysShadow);
  checkUnfinished(counters, context_.log);
  const auto count = [&](const PhotonSystem& system, PhotonMapStats& map) {
    if (!system.isUsed) return;
    map.emitted += context_.now.photonsFor(system.kind);
    if (system.map)
      addCounts(map, system.map->readCounts(context_.stage(), context_.parameters.fluxScale), system.kind);
    else if (cache.isUsed())
      cache.count(counters, map);
  };
  count(global, stats.global);
  count(caustic, stats.caustic);
  stats.photonsEmitted = stats.global.emitted + stats.caustic.emitted;
}

void RunTotals::finish(int passes, const PhotonSystem& caustic, const PhotonSystem& global, const SurfaceCache& cache) {
  RenderStats& stats = context_.stats;
  gpu::Context& gpu = context_.device->context;
  stats.deviceName = gpu.info().name;
  stats.deviceDriver = gpu.info().driver;
  stats.deviceType = gpu.info().type;
  stats.triangles = context_.scene.shownTriangleCount();
  stats.lights = context_.scene.lights.size();
  for (const FeatureRow& row : describeFeatures(context_.scene, context_.job))
    if (row.isModelled) stats.features.push_back(row.name);
  stats.light = lightName(context_.scene);
  stats.gatherFrom = gatherSourceName(context_.job);
  stats.width = static_cast<int>(context_.parameters.width);
  stats.height = static_cast<int>(context_.parameters.height);
  stats.passes = passes;
  stats.devicePeakBytes = gpu.peakBytes();
  stats.devices = {{stats.deviceName, stats.deviceDriver, stats.deviceType, context_.job.seed, passes,
                    stats.photonsEmitted, stats.devicePeakBytes}};
  for (const std::string& message : gpu.takeValidationMessages()) context_.log.warn("validation", message);
  stats.photonMapBytes = global.bytes() + caustic.bytes() + cache.bytes();
  if (cache.hasCells()) addCounts(stats.global, cache.readFlux(), global.kind);
  const std::map<std::string, double> compiled = context_.stage().kernels.compileTimes();
  for (const gpu::KernelTime& t : context_.recorder.times()) {
    const auto found = compiled.find(t.label);
    stats.kernels.push_back({t.label, t.launches, t.milliseconds, found == compiled.end() ? 0 : found->second});
  }
}

void RunTotals::addKept(std::vector<Kept>& state) {
  RenderStats& stats = context_.stats;
  state.push_back(keep("closest rays", stats.closestRays));
  state.push_back(keep("shadow rays", stats.shadowRays));
  state.push_back(keep("photons emitted", stats.photonsEmitted));
  state.push_back(keep("caustic counts", stats.caustic));
  state.push_back(keep("global counts", stats.global));
  state.push_back(keep("passes done", done_));
}

RenderStats sumOf(std::span<const RenderStats> ofDevices) {
  RenderStats sum = ofDevices.front();
  for (const RenderStats& other : ofDevices.subspan(1)) {
    for (const auto count : kSums) sum.*count += other.*count;
    for (const auto seconds : kMeans) sum.seconds.*seconds += other.seconds.*seconds;
    sum.seconds.device = std::max(sum.seconds.device, other.seconds.device);
    addMap(sum.caustic, other.caustic);
    addMap(sum.global, other.global);
    addKernels(sum.kernels, other.kernels);
    sum.passes += other.passes;
    sum.devices.insert(sum.devices.end(), other.devices.begin(), other.devices.end());
  }
  const auto count = static_cast<double>(ofDevices.size());
  for (const auto seconds : kMeans) sum.seconds.*seconds /= count;
  for (PhotonMapStats* map : {&sum.caustic, &sum.global})
    for (auto* flux : {&map->fluxHits, &map->fluxMap})
      for (double& watts : *flux) watts /= count;
  return sum;
}

}  // namespace importon
