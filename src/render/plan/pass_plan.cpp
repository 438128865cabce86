#include "render/plan/pass_plan.h"

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
constexpr double kFewestRequired = 5;          // photons of a caustic lookup, where fewer are required per footprint
constexpr double kFloorPhotons = 20;           // within the largest radius, at least
constexpr int kQuotaPhotons = 8;               // Q
constexpr int kSamplesPerPass = 4;             // camera paths per pixel that share one photon map
constexpr double kLargestLookup = 0.025;       // radius over the scene's largest side
constexpr std::uint64_t kBytesPerPhoton = 96;  // stored, sorted and finished, with its share of the cells
constexpr std::uint64_t kCausticHits = 2;      // of a photon, on average at most: it goes on only through clear coats
constexpr std::uint64_t kBytesPerCell = 200;   // two sides of two halves and of what is read; its part of groups
constexpr uint kProgramFewest = 3;             // neighbours that the program takes for none
constexpr double kUnhurried = 8;               // seconds; in less, passes and what is learned before them are smaller
constexpr double kLeastInHaste = 1.0 / 8;
constexpr int kNearestPhotons = 80;          // of a lookup by the nearest ones
constexpr std::uint64_t kPhotonLevels = 12;  // at which a photon may stand for lookups of the nearest ones
constexpr uint kImportonLevels = 21;         // grid levels at which an importon may stand

/// A lookup of the caustic map never reaches beyond a pixel's footprint but where the map is thin: of fewer required
/// photons it reads fewer.
LookupPhotons causticLookup(const RenderJob& job) {
  LookupPhotons lookup = kCausticLookup;
  if (!job.lookupPhotons) lookup.required = std::clamp(job.causticDensity, kFewestRequired, lookup.required);
  return lookup;
}

/// The program gives no place less than one photon per m².
constexpr float kProgramDensityFloor = 1;

MapSettings mapSettings(const RenderJob& job, double photonsPerPixel, uint mask, double extent, LookupPhotons lookup,
                        std::uint32_t photons) {
  if (job.lookupPhotons)
    lookup = {static_cast<double>(*job.lookupPhotons), lookup.fewest / lookup.required * *job.lookupPhotons};
  const double radius = kLargestLookup * extent;
  MapSettings map{};
  map.photonsPerPixel = static_cast<float>(photonsPerPixel);
  map.constantDensity = static_cast<float>(job.constantDensity.value_or(0));
  map.densityFloor = static_cast<float>(kFloorPhotons / (M_PI * radius * radius));
  if (job.hasProgramLimits) map.densityFloor = kProgramDensityFloor;
  map.recordMask = mask;
  map.lookupPhotons = static_cast<float>(lookup.required);
  map.fewestPhotons = static_cast<float>(lookup.fewest);
  map.densityLimit = std::numeric_limits<float>::max();
  map.photonsPerPass = photons;
  return map;
}

/// Largest radius within which the program looks for neighbours: a disc that, were all hits of `photons` even over the
/// scene's surfaces of `area` m², would hold 1/0.03 times what is looked for. Else none.
float largestQuotaRadius(const RenderJob& job, std::uint32_t photons, double quota, double area) {
  constexpr double kProgramShare = 0.03;
  if (!job.hasProgramLimits) return std::numeric_limits<float>::max();
  return static_cast<float>(std::sqrt(quota * area / (kProgramShare * M_PI * std::max(photons, 1u))));
}

/// Share of what a render with time enough does in a pass and learns before the first one. With a checkpoint it does
/// not depend on time, so that the run is the same wherever it stops.
double shareInHaste(const RenderJob& job) {
  if (!job.seconds || !job.checkpoint.empty() || !job.resume.empty()) return 1;
  return std::clamp(*job.seconds / kUnhurried, kLeastInHaste, 1.0);
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
  plan.maxPasses = job.passes.value_or(job.seconds ? 1 << 20 : 64);
  PassSize& whole = plan.whole;
  whole.samples =
      static_cast<std::uint32_t>(job.gather.value_or(job.integrator == Integrator::photon ? kSamplesPerPass : 1));
  plan.tilePixels = std::min<std::uint64_t>(pixels, kPathsAtOnce / std::min(whole.samples, kFewestAtOnce));
  plan.samplesAtOnce = std::clamp(static_cast<std::uint32_t>(kPathsAtOnce / plan.tilePixels), 1u, whole.samples);
  plan.workspace.slots = plan.tilePixels * plan.samplesAtOnce;
  plan.isAdaptive = job.isAdaptive && !job.gather && job.integrator == Integrator::photon;
  plan.storage.receivers = static_cast<uint>(job.redistribute.value_or(0));
  plan.storage.acceptance = job.acceptance == Acceptance::step ? kAcceptStep : kAcceptCosine;
  plan.storage.shares = static_cast<uint>(job.shares);
  plan.storage.fewest = job.hasProgramLimits ? kProgramFewest : 0;
  plan.storage.probabilityFloor = static_cast<float>(job.probabilityFloor);
  plan.nearestPhotons =
      job.lookup == MapLookup::nearest ? static_cast<uint>(job.lookupPhotons.value_or(kNearestPhotons)) : 0;
  if (job.nearestImportons) plan.nearestImportons = static_cast<uint>(*job.nearestImportons);
  if (job.integrator == Integrator::path) {
    plan.importons = 1;
    plan.workspace.records = 1;
    plan.workspace.entries = plan.workspace.slots;
    return plan;
  }
  plan.workspace.hasCells = features.readsCells;
  plan.workspace.hasDifferentials = job.importance == ImportanceChoice::differentials;
  const auto hurried = [share = shareInHaste(job)](std::uint64_t wanted) {
    return static_cast<std::uint32_t>(share * static_cast<double>(wanted));
  };
  const auto photonsFor = [hurried](std::uint64_t wanted) {
    return hurried(std::clamp<std::uint64_t>(wanted, 1u << 16, 1u << 20));
  };
  whole.photons = photonsFor(pixels);
  whole.causticPhotons =
      photonsFor(2 * pixels * whole.samples);  // a caustic is seen directly: its noise is the image's
  // Both maps share the photons asked for; a caustic map that no surface asks for must not change the image.
  const bool hasTwoMaps = features.needsCausticMap && !job.forcesAllFeatures;
  if (job.photons) whole.photons = whole.causticPhotons = std::max(*job.photons / (hasTwoMaps ? 2 : 1), 1u);
  if (!features.needsCausticMap) whole.causticPhotons = 0;
  const std::uint64_t mostRecords = limits.maxStorageBufferRange / sizeof(MapPoint);
  plan.batch = std::min({std::max(whole.photons, whole.causticPhotons),
                         job.photonBatch.value_or(hurried(limits.isCpu ? 1u << 16 : 1u << 18)),
                         static_cast<std::uint32_t>(std::max<std::uint64_t>(mostRecords / events, 1))});
  plan.importons = job.importons.value_or(hurried(std::clamp<std::uint64_t>(pixels, 1u << 14, 1u << 16)));
  plan.importons =
      std::min(plan.importons, static_cast<std::uint32_t>(std::max<std::uint64_t>(mostRecords / events, 1)));
  const std::uint64_t heapShare = job.memoryMiB ? *job.memoryMiB << 20 : limits.heapBytes / 4;
  const std::uint64_t byRange = limits.maxStorageBufferRange / 24;
  const std::uint64_t mostPhotons = std::min(heapShare / (2 * kBytesPerPhoton), byRange);
  plan.mapCapacity = std::min(whole.photons * events, mostPhotons);
  plan.causticCapacity = std::min(whole.causticPhotons * std::min(events, kCausticHits), mostPhotons);
  plan.mostCells = std::min({16 * pixels + (1u << 18), heapShare / kBytesPerCell, limits.maxStorageBufferRange / 64});
  plan.workspace.slots = std::max<std::uint64_t>({plan.workspace.slots, plan.batch, plan.importons});
  plan.workspace.lightVoxels = std::uint64_t{kLightVoxels} * kLightVoxels * kLightVoxels;
  plan.workspace.records = std::max<std::uint64_t>(plan.batch, plan.importons) * events;
  plan.workspace.entries = std::max<std::uint64_t>({plan.workspace.records, plan.mapCapacity, plan.causticCapacity,
                                                    std::uint64_t{plan.importons} * kImportonLevels});
  if (plan.nearestPhotons > 0)
    plan.workspace.entries = std::max(plan.workspace.entries, std::min(plan.mapCapacity * kPhotonLevels, mostRecords));
  return plan;
}

PassSize PassPlan::sizeOf(int parts) const {
  const auto part = [parts](std::uint32_t n) {
    return (n * static_cast<std::uint64_t>(parts) + kPartsOfPass - 1) / kPartsOfPass;
  };
  return {static_cast<std::uint32_t>(part(whole.samples)), static_cast<std::uint32_t>(part(whole.photons)),
          static_cast<std::uint32_t>(part(whole.causticPhotons))};
}

double surfaceArea(const Scene& scene) {
  double area = 0;
  for (const Triangle& t : scene.worldTriangles())
    area += 0.5 * glm::length(glm::cross(scene.positions[t.v1] - scene.positions[t.v0],
                                         scene.positions[t.v2] - scene.positions[t.v0]));
  scene.placed.visitPages([&](const PlacedInstance&, const Placement& placement, const MeshPage& page) {
    area += page.areas.areaAfter(placement.cofactors());
  });
  return area;
}

Parameters makeParameters(const RenderJob& job, const Scene& scene, const PassPlan& plan, const FilmPlace& film) {
  Parameters p{};
  p.width = static_cast<uint>(film.size.x);
  p.height = static_cast<uint>(film.size.y);
  p.imageSize = uvec2(film.whole);
  p.filmCorner = uvec2(film.corner);
  const Camera& camera = chooseCamera(scene, job);
  setCamera(p, camera, chooseLens(camera, job), scene);
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
  p.samplesPerPass = plan.whole.samples;
  p.maxDepth = static_cast<uint>(job.maxDepth);
  p.fluxScale = chooseFluxScale(power, job.maxDepth);
  p.quotaPhotons = static_cast<float>(job.quota.value_or(kQuotaPhotons));
  p.largestQuotaRadius = largestQuotaRadius(job, plan.whole.photons, p.quotaPhotons, surfaceArea(scene));
  if (job.background && !job.isTransparent)
    p.background = vec3((*job.background)[0], (*job.background)[1], (*job.background)[2]);
  p.densityScale = 1;
  p.importonFlux = 1;
  p.causticMap =
      mapSettings(job, job.causticDensity, kRecordCaustic, longest, causticLookup(job), plan.whole.causticPhotons);
  p.globalMap = mapSettings(job, job.globalDensity, kRecordGlobal, longest, kGlobalLookup, plan.whole.photons);
  return p;
}

}  // namespace importon
