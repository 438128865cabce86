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
constexpr float kPassesInCells = 4;                  // in each half of the surface cells before they are cut anew

}  // namespace

void RenderSession::tracePilot(const PhotonSource& source, std::uint32_t first, std::uint32_t count) {
  tracePhotons(*stage_, source, first, count, parameters_.maxDepth);
  stats_.photonsPilot += count;
}

void RenderSession::trainGuides() {
  if (job_.emission == EmissionChoice::power || plan_.whole.photons == 0) return;
  startPass(0);
  const auto train = [&](std::optional<EmissionGuide>& guide, MapKind kind, const ImportanceMap& importance, int bins) {
    guide.emplace(*context_, scene_, kind, bins, job_.guideWeight == GuideWeight::potential);
    const std::uint32_t photons = std::min(plan_.batch, plan_.whole.photonsFor(kind));
    tracePilot({kind, &*guide}, 0, photons);
    selectRecords(*stage_, recordMask(kind));
    if (job_.guideWeight == GuideWeight::deficit)
      guide->followDeficits(*stage_, importance, parameters_, static_cast<float>(plan_.whole.photonsFor(kind)) / static_cast<float>(photons));
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
  const auto find = [&](MapKind kind, const ImportanceMap& importance, const std::optional<EmissionGuide>& guide) {
    const SiteHits sites(*context_, kind, importance, parameters_);
    ShootingRule rule;
    const float passes = kind == MapKind::global && features_.readsCells ? kPassesInCells : 1;
    const std::uint32_t most = plan_.whole.photonsFor(kind);
    const std::uint32_t step = std::clamp(most / kEnoughSteps, std::min(kFewestInStep, plan_.batch), plan_.batch);
    std::uint32_t shot = 0;
    do {
      const std::uint32_t count = std::min(step, most - shot);
      tracePilot({kind, guide ? &*guide : nullptr, true}, shot, count);
      selectRecords(*stage_, recordMask(kind));
      sites.count(*stage_);
      shot += count;
    } while (shot < most && !rule.isEnough(sites.supply(*stage_, passes)));
    recorder_->submitAndWait();
    return shot;
  };
  const std::uint32_t global = find(MapKind::global, importance_.global, globalGuide_);
  if (causticMap_) plan_.whole.causticPhotons = find(MapKind::caustic, importance_.caustic, causticGuide_);
  plan_.whole.photons = global;
  now_ = plan_.whole;
}

}  // namespace importon
