// How a render in progress learns, before its first pass, where photons are to go and how many.
#include <algorithm>

#include "render/photon_pass.h"
#include "render/render_session.h"

namespace importon {
namespace {

constexpr int kCausticBins = 128, kGlobalBins = 16;  // of a guide, along both axes of a light's unit square
constexpr double kLeastGain = 1.5;                   // learned, from which on global photons are guided
constexpr std::uint32_t kEnoughSteps = 32;           // into which a pass's photons are cut to see when it is enough
constexpr std::uint32_t kFewestInStep = 512;
constexpr std::uint32_t kScatterImportons = 1u << 17;  // that teach scattering, at most
constexpr std::uint32_t kMostLessons = 64;             // batches of them, however small the batches are
constexpr float kPassesInCells = 4;                  // in each half of the surface cells before they are cut anew

}  // namespace

void RenderSession::tracePilot(const PhotonSource& source, std::uint32_t first, std::uint32_t count) {
  tracePhotons(*stage_, source, first, count, parameters_.maxDepth);
  selectRecords(*stage_, recordMask(source.kind));
  stats_.photonsPilot += count;
}

void RenderSession::tracePilots(const PhotonSource& source, std::uint32_t photons, const std::function<void()>& count) {
  for (std::uint32_t first = 0; first < photons; first += plan_.batch) {
    tracePilot(source, first, std::min(plan_.batch, photons - first));
    count();
  }
  recorder_->submitAndWait();
}

EmissionGuide* RenderSession::guideFor(MapKind kind) {
  std::optional<EmissionGuide>& guide = kind == MapKind::global ? globalGuide_ : causticGuide_;
  return guide ? &*guide : nullptr;
}

PhotonSource RenderSession::sourceOf(MapKind kind, bool isPilot) {
  return {kind, guideFor(kind), isPilot, kind == MapKind::global && scatterGuide_ ? &*scatterGuide_ : nullptr};
}

void RenderSession::trainScatter() {
  if (job_.scatter == ScatterChoice::material || plan_.whole.photons == 0 || importance_.global.count == 0) return;
  startPass(0);
  ScatterLesson lesson{0, 0, meanImportance(), parameters_.maxDepth};
  std::optional<SiteHits> sites;
  if (job_.guideWeight == GuideWeight::deficit) {
    const std::uint32_t photons = std::min(plan_.batch, plan_.whole.photons);
    tracePilot({MapKind::global, nullptr, true}, 0, photons);
    sites.emplace(device_->context, MapKind::global, importance_.global, parameters_);
    sites->count(*stage_);
    lesson.sites = &*sites;
    lesson.hitsPerPass = static_cast<float>(plan_.whole.photons) / static_cast<float>(photons);
  }
  scatterGuide_.emplace(device_->context, parameters_, job_.guideWeight);
  const std::uint64_t batches = std::uint64_t{kMostLessons} * plan_.batch;
  const std::uint64_t most = std::min<std::uint64_t>(kScatterImportons, std::uint64_t{kLearningPasses} * plan_.whole.photons);
  const auto importons = static_cast<std::uint32_t>(std::min(most, batches));
  stats_.photonsPilot += importons;
  for (; lesson.first < importons; lesson.first += lesson.count) {
    lesson.count = std::min(plan_.batch, importons - lesson.first);
    teachScatter(*stage_, importance_.global, *scatterGuide_, lesson);
  }
  recorder_->submitAndWait();
  scatterGuide_->update();
}

void RenderSession::trainGuides() {
  trainScatter();
  if (job_.emission == EmissionChoice::power || plan_.whole.photons == 0) return;
  startPass(0);
  const auto train = [&](std::optional<EmissionGuide>& guide, MapKind kind, const ImportanceMap& importance, int bins) {
    guide.emplace(device_->context, scene_, kind, bins, job_.guideWeight);
    const std::uint32_t photons = std::min(plan_.batch, plan_.whole.photonsFor(kind));
    tracePilot(sourceOf(kind, false), 0, photons);
    if (job_.guideWeight == GuideWeight::deficit)
      guide->followDeficits(*stage_, importance, parameters_,
                            static_cast<float>(plan_.whole.photonsFor(kind)) / static_cast<float>(photons));
    guide->learn(*stage_, importance, meanImportance());
    recorder_->submitAndWait();
    guide->update();
  };
  train(globalGuide_, MapKind::global, importance_.global, kGlobalBins);
  if (job_.emission == EmissionChoice::automatic && globalGuide_->gain() < kLeastGain) globalGuide_.reset();
  if (causticMap_) train(causticGuide_, MapKind::caustic, importance_.caustic, kCausticBins);
}

void RenderSession::findEnoughPhotons() {
  if (job_.shooting == PhotonsShot::all || plan_.whole.photons == 0) return;
  startPass(0);
  const auto find = [&](MapKind kind, const ImportanceMap& importance) {
    const SiteHits sites(device_->context, kind, importance, parameters_);
    ShootingRule rule;
    const float passes = kind == MapKind::global && features_.readsCells ? kPassesInCells : 1;
    const std::uint32_t most = plan_.whole.photonsFor(kind);
    const std::uint32_t step = std::clamp(most / kEnoughSteps, std::min(kFewestInStep, plan_.batch), plan_.batch);
    std::uint32_t shot = 0;
    do {
      const std::uint32_t count = std::min(step, most - shot);
      tracePilot(sourceOf(kind, true), shot, count);
      sites.count(*stage_);
      shot += count;
    } while (shot < most && !rule.isEnough(sites.supply(*stage_, passes)));
    recorder_->submitAndWait();
    return shot;
  };
  const std::uint32_t global = find(MapKind::global, importance_.global);
  if (causticMap_) plan_.whole.causticPhotons = find(MapKind::caustic, importance_.caustic);
  plan_.whole.photons = global;
  now_ = plan_.whole;
}

void RenderSession::countCausticHits() {
  if (!causticMap_ || importance_.caustic.count == 0 || now_.causticPhotons == 0) return;
  startPass(0);
  const uint weight = std::max(now_.causticPhotons / plan_.batch, 1u);  // of a share of the photons of a pass
  gpu::BindingTable table = work_->table;
  importance_.caustic.bind(table);
  tracePilots(sourceOf(MapKind::caustic, true), now_.causticPhotons / weight, [&] {
    overItems(*stage_, device_->kernels.hitCount, table, kCounterSelected, HitCountPush{false, weight});
  });
  done_.causticCounted = now_.causticPhotons;
}

void RenderSession::expectDensity() {
  if (control_ != DensityControl::probability) return;
  startPass(0);
  const auto count = [&](std::optional<ExpectedDensity>& expected, MapKind kind, const ImportanceMap& importance) {
    expected.emplace(device_->context, kind, plan_.capacityFor(kind));
    tracePilots(sourceOf(kind, true), now_.photonsFor(kind), [&] { expected->count(*stage_, importance); });
  };
  count(globalExpected_, MapKind::global, importance_.global);
  if (causticMap_) count(causticExpected_, MapKind::caustic, importance_.caustic);
}

}  // namespace importon
