#include "render/photons/pilots.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>
#include <memory>

#include "kernels/hit_count.h"
#include "render/importance/light_share.h"
#include "render/lists/lists.h"

namespace importon {
namespace {

constexpr std::uint32_t kEnoughSteps = 32;  // into which a pass's photons are cut to see when it is enough
constexpr std::uint32_t kFewestInStep = 512;
constexpr std::uint32_t kScatterImportons = 1u << 17;  // that train scattering, at most
constexpr std::uint32_t kMostBatches = 64;             // of them, however small the batches are
constexpr std::uint32_t kEscapePaths = 1u << 16;       // of importance, that aim the environment's photons, at most
constexpr std::uint32_t kFirstEscapePaths = 1u << 13;  // that decide whether to
constexpr float kPassesInCells = 4;                    // in each half of the surface cells before they are cut anew

/// Traces importance from where the image reads the map, which trains photons which way to scatter. [Peter and Pietrek
/// 1998]
void trainScatter(PassContext& context, PhotonSystem& system) {
  const bool isGuided = context.job.scatter != ScatterChoice::material && traitsOf(system.kind).guidesScatter;
  if (!isGuided || system.importance.count == 0) return;
  const Stage stage = context.stage();
  context.beginPilot();
  const std::uint32_t photons = context.plan.whole.photonsFor(system.kind), batch = context.plan.batch;
  ScatterBatch train{0, 0, context.meanImportance(), context.parameters.maxDepth};
  std::optional<SiteHits> sites;
  if (context.job.guideWeight == GuideWeight::deficit) {
    const std::uint32_t few = std::min(batch, photons);
    tracePilot(context, {system.kind, nullptr, true}, 0, few);
    sites.emplace(stage.gpu, system.kind, system.importance, context.parameters);
    sites->count(stage);
    train.sites = &*sites;
    train.hitsPerPass = static_cast<float>(photons) / static_cast<float>(few);
  }
  system.scatter.emplace(stage.gpu, context.parameters, context.job.guideWeight);
  const std::uint64_t most = std::min<std::uint64_t>(kScatterImportons, std::uint64_t{kTrainingPasses} * photons);
  const auto importons = static_cast<std::uint32_t>(std::min(most, std::uint64_t{kMostBatches} * batch));
  context.stats.photonsPilot += importons;
  for (; train.first < importons; train.first += train.count) {
    train.count = std::min(batch, importons - train.first);
    trainScatterGuide(stage, system.importance, *system.scatter, train);
  }
  stage.recorder.submitAndWait();
  system.scatter->update();
}

/// Importance finds the way out to the environment. Null where that brings nothing.
std::shared_ptr<const EnvironmentGuide> aimAtEscapes(PassContext& context, const PhotonSystem& system,
                                                     const EmissionGuide& emission) {
  const std::uint32_t paths = std::min(kEscapePaths, 2 * context.plan.whole.photonsFor(system.kind));
  if (context.parameters.environmentLight == kNone || system.importance.count == 0 || paths == 0) return nullptr;
  const Stage stage = context.stage();
  const auto guide = std::make_shared<EnvironmentGuide>(stage.gpu, paths);
  ScatterBatch batch{
      0, 0, context.meanImportance(), context.parameters.maxDepth, emission.sites(), emission.hitsPerPass()};
  const double radius = static_cast<double>(context.parameters.sceneRadius);
  // A few tell whether it is worth it: most scenes lie open under their sky.
  auto worth = EnvironmentGuide::Worth::unknown;
  for (std::uint32_t end = std::min(kFirstEscapePaths, paths); batch.first < paths; end = paths) {
    for (; batch.first < end; batch.first += batch.count) {
      batch.count = std::min(context.plan.batch, end - batch.first);
      noteEscapes(stage, system.kind, system.importance, *guide, batch);
      context.stats.photonsPilot += batch.count;
    }
    stage.recorder.submitAndWait();
    worth = guide->update(end, glm::pi<double>() * radius * radius);
    if (worth == EnvironmentGuide::Worth::little) return nullptr;
  }
  return worth == EnvironmentGuide::Worth::much ? guide : nullptr;
}

void trainEmission(PassContext& context, PhotonSystem& system) {
  if (context.job.emission == EmissionChoice::power || !system.isUsed) return;
  const Stage stage = context.stage();
  const MapTraits traits = traitsOf(system.kind);
  context.beginPilot();
  EmissionGuide& guide =
      system.emission.emplace(stage.gpu, context.scene, system.kind, traits.guideBins, context.job.guideWeight);
  const std::uint32_t perPass = context.plan.whole.photonsFor(system.kind),
                      photons = std::min(context.plan.batch, perPass);
  tracePilot(context, system.source(false), 0, photons);
  if (context.job.guideWeight == GuideWeight::deficit)
    guide.followDeficits(stage, system.importance, context.parameters,
                         static_cast<float>(perPass) / static_cast<float>(photons));
  guide.train(stage, system.importance, context.meanImportance());
  if (auto aim = aimAtEscapes(context, system, guide))
    guide.aimEnvironment(std::move(aim), context.parameters.environmentLight);
  stage.recorder.submitAndWait();
  guide.update();
  if (context.job.emission == EmissionChoice::automatic && guide.gain() < traits.leastGain && !guide.aimsEnvironment())
    system.emission.reset();
}

/// Where photons of a pilot fall, and with how much light of a pass.
void addPilotLight(PassContext& context, MapKind kind, std::vector<LightPoint>& light) {
  const std::uint32_t perPass = context.plan.whole.photonsFor(kind), photons = std::min(context.plan.batch, perPass);
  if (photons == 0) return;
  tracePilot(context, {kind, nullptr, true}, 0, photons);
  context.recorder.submitAndWait();
  const float scale = static_cast<float>(perPass) / static_cast<float>(photons);
  const uint count = readCounter(context.stage(), kCounterRecords);
  const auto points = context.work.recordPoints.download<MapPoint>(count);
  const auto records = context.work.records.download<Record>(count);
  for (std::size_t i = 0; i < count; ++i) {
    if ((records[i].kind & recordMask(kind)) == 0) continue;
    const vec3 flux = records[i].flux;
    light.push_back({points[i].position, scale * (flux.x + flux.y + flux.z), kind == MapKind::caustic});
  }
}

}  // namespace

void tracePilot(PassContext& context, const PhotonSource& source, std::uint32_t first, std::uint32_t count) {
  tracePhotons(context.stage(), source, first, count, context.parameters.maxDepth);
  selectRecords(context.stage(), recordMask(source.kind));
  context.stats.photonsPilot += count;
}

void tracePilots(PassContext& context, const PhotonSource& source, std::uint32_t photons,
                 const std::function<void()>& count) {
  for (std::uint32_t first = 0; first < photons; first += context.plan.batch) {
    tracePilot(context, source, first, std::min(context.plan.batch, photons - first));
    count();
  }
  context.recorder.submitAndWait();
}

void trainGuides(PassContext& context, PhotonSystem& system) {
  if (context.plan.whole.photons == 0) return;
  trainScatter(context, system);
  trainEmission(context, system);
}

void findEnoughPhotons(PassContext& context, const PhotonSystem& system) {
  if (context.job.shooting == PhotonsShot::all || context.plan.whole.photons == 0 || !system.isUsed) return;
  const Stage stage = context.stage();
  context.beginPilot();
  const SiteHits sites(stage.gpu, system.kind, system.importance, context.parameters);
  ShootingRule rule;
  const float passes = system.map ? 1 : kPassesInCells;
  const std::uint32_t most = context.plan.whole.photonsFor(system.kind), batch = context.plan.batch;
  const std::uint32_t step = std::clamp(most / kEnoughSteps, std::min(kFewestInStep, batch), batch);
  std::uint32_t shot = 0;
  do {
    const std::uint32_t count = std::min(step, most - shot);
    tracePilot(context, system.source(true), shot, count);
    sites.count(stage);
    shot += count;
  } while (shot < most && !rule.isEnough(sites.supply(stage, passes)));
  stage.recorder.submitAndWait();
  context.plan.whole.photonsFor(system.kind) = shot;
  context.now = context.plan.whole;
}

void expectDensity(PassContext& context, PhotonSystem& system) {
  if (system.control != DensityControl::probability || !system.isUsed) return;
  context.beginPilot();
  system.expected.emplace(context.device->context, system.kind, context.plan.capacityFor(system.kind));
  tracePilots(context, system.source(true), context.now.photonsFor(system.kind),
              [&] { system.expected->count(context.stage(), system.importance); });
}

std::uint32_t countFirstHits(PassContext& context, const PhotonSystem& system) {
  const std::uint32_t photons = context.now.photonsFor(system.kind);
  if (!system.map || !traitsOf(system.kind).countsFirstHits || system.importance.count == 0 || photons == 0) return 0;
  context.beginPilot();
  const uint weight = std::max(photons / context.plan.batch, 1u);  // of a share of the photons of a pass
  tracePilots(context, system.source(true), photons / weight, [&] {
    overItems<kernels::HitCount>(context.stage(), kCounterSelected, {.isGlobal = false, .weight = weight},
                                 system.importance.buffers());
  });
  return photons;
}

void requireLessInOtherLight(PassContext& context, PhotonSystem& caustic, const PhotonSystem& global) {
  if (context.job.requiredBy != RequiredBy::contribution || !caustic.map || caustic.importance.count == 0) return;
  context.beginPilot();
  std::vector<LightPoint> light;
  addPilotLight(context, caustic.kind, light);
  addPilotLight(context, global.kind, light);
  scaleByCausticShare(context.stage(), caustic.importance,
                      LightShare(light, context.parameters.gridOrigin, context.parameters.gridExtent));
}

}  // namespace importon
