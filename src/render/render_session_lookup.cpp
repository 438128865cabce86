// How a render chooses, before its first pass, how many photons its lookups have: --lookup-photons auto.
#include <array>

#include "fmt/format.h"
#include "render/eye_pass.h"
#include "render/lookup_choice.h"
#include "render/photon_pass.h"
#include "render/render_session.h"

namespace importon {
namespace {

constexpr std::array kTrials{5, 8, 14, 20, 40, 80};
constexpr int kPassesToCome = 16;  // where no number is given

}  // namespace

std::vector<float> RenderSession::seeMap(MapKind kind) {
  const PhotonMap& map = kind == MapKind::global ? *globalMap_ : *causticMap_;
  const EyeMaps maps{&importance_, kind == MapKind::caustic ? &map : nullptr, kind == MapKind::global ? &map : nullptr};
  const uint layer = kAovMapLight + (kind == MapKind::global ? 3 : 0);
  std::vector<float> seen;
  for (const FilmTile& tile : film_->tiles()) {
    const gpu::Buffer buffer(device_->context, "AOVs", std::uint64_t{tile.count} * kAovFloats * sizeof(float));
    traceAovs(*stage_, maps, tile.first, tile.count, buffer);
    recorder_->submitAndWait();
    const auto values = buffer.download<float>(std::uint64_t{tile.count} * kAovFloats);
    for (std::size_t pixel = 0; pixel < tile.count; ++pixel)
      for (uint c = 0; c < 3; ++c) seen.push_back(values[pixel * kAovFloats + layer + c]);
  }
  return seen;
}

void RenderSession::shootTrialMap(MapKind kind, MapSettings& settings, bool isSecond) {
  const bool isGlobal = kind == MapKind::global;
  PhotonMap& map = isGlobal ? *globalMap_ : *causticMap_;
  const ImportanceMap& importance = isGlobal ? importance_.global : importance_.caustic;
  const std::uint32_t photons = now_.photonsFor(kind);
  startPass(0);
  setPhotons(settings, photons, isSecond ? photons : 0, 0);
  settings.photonsCounted = 1;
  uploadParameters();
  recorder_->fill(importance.hits, 0);
  map.begin(*stage_);
  tracePilots(sourceOf(kind, true), photons, [&] { map.addBatch(*stage_, importance, storageRule(kind)); });
}

void RenderSession::chooseLookups(MapKind kind, MapSettings& settings) {
  const bool isGlobal = kind == MapKind::global;
  std::optional<PhotonMap>& map = isGlobal ? globalMap_ : causticMap_;
  const ImportanceMap& importance = isGlobal ? importance_.global : importance_.caustic;
  if (!job_.choosesLookups || !map || importance.count == 0 || now_.photonsFor(kind) == 0) return;
  const float fewest = settings.fewestPhotons / settings.lookupPhotons;
  const auto lookUpWith = [&](int photons) {
    settings.lookupPhotons = static_cast<float>(photons);
    settings.fewestPhotons = fewest * settings.lookupPhotons;
  };
  std::vector<LookupTrial> trials;
  for (const int photons : kTrials) trials.push_back({photons, {}, {}});
  for (const bool isSecond : {false, true}) {
    shootTrialMap(kind, settings, isSecond);
    for (LookupTrial& trial : trials) {
      lookUpWith(trial.photons);
      uploadParameters();
      map->finish(*stage_, importance, plan_.nearestPhotons);
      (isSecond ? trial.b : trial.a) = seeMap(kind);
    }
  }
  recorder_->fill(importance.hits, 0);
  recorder_->submitAndWait();
  const int chosen = chooseLookupPhotons(trials, job_.passes.value_or(kPassesToCome));
  lookUpWith(chosen);
  log_.note(fmt::format("lookups of the {} map: {} photons", isGlobal ? "global" : "caustic", chosen));
}

}  // namespace importon
