#include "render/pass_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace importon {
namespace {

struct LookupPhotons {
  double required, fewest;
};

// Photons of a lookup, M, and the fewest on average where the map is thin. What the camera sees directly must not be
// noisy; gathers average many lookups, and a small radius loses less light at edges.
constexpr LookupPhotons kCausticLookup{20, 8}, kGlobalLookup{8, 5};
constexpr double kFloorPhotons = 20;        // within the largest radius, at least
constexpr double kQuotaPhotons = 8;         // Q
constexpr int kSamplesPerPass = 4;          // camera paths per pixel that share one photon map
constexpr double kLargestLookup = 0.025;     // radius over the scene's largest side
constexpr std::uint64_t kBytesPerPhoton = 96;  // stored, sorted and finished, with its share of the cells
constexpr std::uint64_t kBytesPerCell = 128;    // two sides, two halves
constexpr uint kImportonLevels = 21;        // grid levels at which an importon may stand

MapSettings mapSettings(const RenderJob& job, double photonsPerPixel, uint mask, double extent, LookupPhotons lookup) {
  const double radius = kLargestLookup * extent;
  MapSettings map{};
  map.photonsPerPixel = static_cast<float>(photonsPerPixel);
  map.constantDensity = static_cast<float>(job.constantDensity.value_or(0));
  map.densityFloor = static_cast<float>(kFloorPhotons / (M_PI * radius * radius));
  map.recordMask = mask;
  map.lookupPhotons = static_cast<float>(lookup.required);
  map.fewestPhotons = static_cast<float>(lookup.fewest);
  map.densityLimit = std::numeric_limits<float>::max();
  return map;
}

/// A power of two such that all flux that a map may hold stays below 2^62 units.
float chooseFluxScale(double power, int maxDepth) {
  const double most = 4 * power * (maxDepth + 2);
  return static_cast<float>(std::exp2(std::clamp(61.0 - std::ceil(std::log2(most)), -120.0, 120.0)));
}

}  // namespace

PassPlan planPasses(const RenderJob& job, const FeatureSet& features, glm::ivec2 size, const gpu::Limits& limits) {
  const std::uint64_t pixels = static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y);
  const std::uint64_t events = static_cast<std::uint64_t>(job.maxDepth) + 1;
  PassPlan plan;
  plan.tilePixels = std::min<std::uint64_t>(pixels, 1u << 18);
  plan.maxPasses = job.passes.value_or(job.seconds ? 1 << 20 : 64);
  plan.workspace.slots = plan.tilePixels;
  plan.samples = static_cast<std::uint32_t>(job.gather.value_or(job.integrator == Integrator::photon ? kSamplesPerPass : 1));
  plan.receivers = static_cast<uint>(job.redistribute.value_or(0));
  if (job.integrator == Integrator::path) {
    plan.importons = 1;
    plan.workspace.records = 1;
    plan.workspace.entries = plan.workspace.slots;
    return plan;
  }
  plan.workspace.hasDifferentials = job.importance == ImportanceChoice::differentials;
  plan.photons = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(pixels, 1u << 16, 1u << 20));
  // Both maps share the photons asked for; a caustic map that no surface asks for must not change the image.
  const bool hasTwoMaps = features.needsCausticMap && !job.forcesAllFeatures;
  if (job.photons) plan.photons = std::max(*job.photons / (hasTwoMaps ? 2 : 1), 1u);
  const std::uint64_t mostRecords = limits.maxStorageBufferRange / sizeof(MapPoint);
  plan.batch = std::min({plan.photons, job.photonBatch.value_or(limits.isCpu ? 1u << 16 : 1u << 18),
                         static_cast<std::uint32_t>(std::max<std::uint64_t>(mostRecords / events, 1))});
  plan.importons = job.importons.value_or(static_cast<std::uint32_t>(std::clamp<std::uint64_t>(pixels, 1u << 14, 1u << 16)));
  plan.importons = std::min(plan.importons, static_cast<std::uint32_t>(std::max<std::uint64_t>(mostRecords / events, 1)));
  const std::uint64_t heapShare = job.memoryMiB ? *job.memoryMiB << 20 : limits.heapBytes / 4;
  const std::uint64_t byRange = limits.maxStorageBufferRange / 24;
  plan.mapCapacity = std::min({plan.photons * events, heapShare / (2 * kBytesPerPhoton), byRange});
  plan.mostCells = std::min({16 * pixels + (1u << 18), heapShare / kBytesPerCell, limits.maxStorageBufferRange / 64});
  plan.workspace.slots = std::max<std::uint64_t>({plan.workspace.slots, plan.batch, plan.importons});
  plan.workspace.lightVoxels = std::uint64_t{kLightVoxels} * kLightVoxels * kLightVoxels;
  plan.workspace.records = std::max<std::uint64_t>(plan.batch, plan.importons) * events;
  plan.workspace.entries = std::max<std::uint64_t>(
      {plan.workspace.records, plan.mapCapacity, std::uint64_t{plan.importons} * kImportonLevels});
  return plan;
}

Parameters makeParameters(const RenderJob& job, const Scene& scene, const PassPlan& plan, glm::ivec2 size) {
  Parameters p{};
  p.width = static_cast<uint>(size.x);
  p.height = static_cast<uint>(size.y);
  setCamera(p, chooseCamera(scene, job), scene);
  const vec3 sides = scene.boundsMax - scene.boundsMin;
  const float longest = std::max({sides.x, sides.y, sides.z});
  p.gridOrigin = scene.boundsMin;
  p.gridExtent = std::exp2(std::ceil(std::log2(longest * 1.0001f)));
  p.sceneCentre = 0.5f * (scene.boundsMin + scene.boundsMax);
  p.sceneRadius = 0.5f * glm::length(sides);
  if (scene.environment) p.environmentSize = uvec2(scene.environment->width, scene.environment->height);
  p.environmentLight = kNone;
  double power = 0;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    power += scene.lights[i].power;
    if (scene.lights[i].kind == kLightEnvironment) p.environmentLight = static_cast<uint>(i);
  }
  p.lightCount = static_cast<uint>(scene.lights.size());
  p.totalPower = static_cast<float>(power);
  p.seed = job.seed;
  p.photonsPerPass = plan.photons;
  p.samplesPerPass = plan.samples;
  p.maxDepth = static_cast<uint>(job.maxDepth);
  p.fluxScale = chooseFluxScale(power, job.maxDepth);
  p.quotaPhotons = static_cast<float>(kQuotaPhotons);
  p.densityScale = 1;
  p.importonFlux = 1;
  p.causticMap = mapSettings(job, job.causticDensity, kRecordCaustic, longest, kCausticLookup);
  p.globalMap = mapSettings(job, job.globalDensity, kRecordGlobal, longest, kGlobalLookup);
  return p;
}

}  // namespace importon
