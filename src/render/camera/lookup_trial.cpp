#include "render/camera/lookup_trial.h"

#include <fmt/format.h>

#include <array>

#include "render/camera/lookup_choice.h"
#include "render/photons/pilots.h"

namespace importon {
namespace {

constexpr std::array kTrials{5, 8, 14, 20, 40, 80};
constexpr int kPassesToCome = 16;  // where no number is given

/// Radiance of a finished map where the camera looks: three channels of each pixel.
std::vector<float> seeMap(const CameraPass& camera, const EyeMaps& maps, MapKind kind) {
  const uint layer = kAovMapLight + 3 * static_cast<uint>(kind);
  const std::vector<float> values = camera.traceAovs(maps);
  std::vector<float> seen;
  for (std::size_t first = 0; first < values.size(); first += kAovFloats)
    for (uint c = 0; c < 3; ++c) seen.push_back(values[first + layer + c]);
  return seen;
}

/// Fills the map with a pass's photons that are in no other; a second time, with others.
void shootTrialMap(PassContext& context, PhotonSystem& system, MapSettings& settings, bool isSecond) {
  const Stage stage = context.stage();
  const std::uint32_t photons = context.now.photonsFor(system.kind);
  PassSums before;
  before.of(system.kind).shot = isSecond ? photons : 0;
  context.setPass(0, before);
  settings.photonsCounted = 1;
  context.begin();
  stage.recorder.fill(system.importance.hits, 0);
  system.map->begin(stage);
  tracePilots(context, system.source(true), photons,
              [&] { system.map->addBatch(stage, system.importance, system.storageRule(context.plan)); });
}

}  // namespace

void chooseLookups(PassContext& context, PhotonSystem& system, const CameraPass& camera, EyeMaps maps) {
  if (!context.job.choosesLookups || !system.map || system.importance.count == 0 ||
      context.now.photonsFor(system.kind) == 0)
    return;
  maps.see(system.kind, *system.map);
  MapSettings& settings = context.parameters.*traitsOf(system.kind).settings;
  const float fewest = settings.fewestPhotons / settings.lookupPhotons;
  const auto lookUpWith = [&](int photons) {
    settings.lookupPhotons = static_cast<float>(photons);
    settings.fewestPhotons = fewest * settings.lookupPhotons;
  };
  std::vector<LookupTrial> trials;
  for (const int photons : kTrials) trials.push_back({photons, {}, {}});
  for (const bool isSecond : {false, true}) {
    shootTrialMap(context, system, settings, isSecond);
    for (LookupTrial& trial : trials) {
      lookUpWith(trial.photons);
      context.upload();
      system.map->finish(context.stage(), system.importance, context.plan.nearestPhotons);
      (isSecond ? trial.b : trial.a) = seeMap(camera, maps, system.kind);
    }
  }
  context.recorder.fill(system.importance.hits, 0);
  context.recorder.submitAndWait();
  const int chosen = chooseLookupPhotons(trials, context.job.passes.value_or(kPassesToCome));
  lookUpWith(chosen);
  context.log.note(fmt::format("lookups of the {} map: {} photons", traitsOf(system.kind).name, chosen));
}

}  // namespace importon
