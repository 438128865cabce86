#include "render/renderer.h"

#include <fmt/format.h>

#include "base/clock.h"
#include "base/hash.h"
#include "render/camera/aov_layers.h"
#include "render/camera/lookup_trial.h"
#include "render/film/aov_image.h"
#include "render/photons/pilots.h"
#include "render/resume/job_fingerprint.h"

namespace importon {
Renderer::Renderer(const RenderJob& job, const Scene& scene, Log& log, const RenderSources& sources)
    : context_(job, scene, log, stats_, sources),
      caustic_(context_, MapKind::caustic),
      global_(context_, MapKind::global),
      cache_(context_),
      camera_(context_),
      totals_(context_) {}

void Renderer::prepare() {
  if (!context_.hasMaps()) return;
  const Clock::time_point start = Clock::now();
  findImportance();
  requireLessInOtherLight(context_, caustic_, global_);
  for (PhotonSystem* system : {&global_, &caustic_}) {
    trainGuides(context_, *system);
    findEnoughPhotons(context_, *system);
    expectDensity(context_, *system);
    chooseLookups(context_, *system, camera_, {&caustic_.importance, &global_.importance});
    totals_.done().of(system->kind).counted = countFirstHits(context_, *system);
  }
  cache_.learnHits();
  stats_.seconds.importance = secondsSince(start);
}

void Renderer::findImportance() {
  buildImportance(context_.stage(), context_.parameters, caustic_.importance, global_.importance,
                  {context_.plan.importons, context_.plan.nearestImportons, caustic_.map.has_value()});
  // A camera that sees no surface to light needs no photons, nor does a scene that has no light to shoot them.
  if (context_.scene.lights.empty() || (global_.importance.count == 0 && caustic_.importance.count == 0))
    for (PassSize* size : {&context_.now, &context_.plan.whole}) size->photons = size->causticPhotons = 0;
  cache_.learnImportance();
  stats_.importonsEmitted = context_.plan.importons;
  stats_.importonsCaustic = caustic_.importance.count;
  stats_.importonsGlobal = global_.importance.count;
}

void Renderer::renderPass(int pass, int parts) {
  context_.now = context_.plan.sizeOf(parts);
  context_.setPass(pass, totals_.done());
  cutCells(pass);
  context_.begin();
  shootPhotons(pass);
  gatherImage(pass);
  totals_.countPass(pass, caustic_, global_, cache_);
}

void Renderer::cutCells(int pass) {
  if (!cache_.isUsed()) return;
  const Clock::time_point start = Clock::now();
  cache_.beginPass(pass);
  stats_.seconds.cells += secondsSince(start);
}

void Renderer::shootPhotons(int pass) {
  if (!context_.hasMaps()) return;
  const Clock::time_point start = Clock::now();
  const auto shoot = [&](bool isFirst) {
    const bool fillsCache = cache_.isUsed() && isFirst;
    global_.shoot(context_, isFirst, fillsCache ? [this] { cache_.addBatch(); } : std::function<void()>());
    if (fillsCache) cache_.smooth();
    caustic_.shoot(context_, isFirst, nullptr);
    context_.recorder.submitAndWait();
    const auto counters = context_.work.counters.download<uint>(kCounterCount);
    return !caustic_.isFull(counters) && !global_.isFull(counters);
  };
  for (bool isFirst = true; !shoot(isFirst); isFirst = false) {
    tightenDensityLimit(context_, caustic_, global_);
    context_.upload();
  }
  if (cache_.isUsed()) cache_.endPass(pass);
  for (PhotonSystem* system : {&global_, &caustic_}) system->endPass(context_);
  stats_.seconds.photons += secondsSince(start);
}

void Renderer::gatherImage(int pass) {
  const Clock::time_point start = Clock::now();
  camera_.gather(pass, totals_.done(), eyeMaps());
  stats_.seconds.gather += secondsSince(start);
}

EyeMaps Renderer::eyeMaps() const {
  EyeMaps maps{&caustic_.importance, &global_.importance};
  for (const PhotonSystem* system : {&caustic_, &global_})
    if (system->map && system->map->isFinished()) maps.see(system->kind, *system->map);
  maps.hasCells = cache_.hasCells();
  return maps;
}

std::vector<Kept> Renderer::state() {
  std::vector<Kept> state;
  camera_.addKept(state);
  totals_.addKept(state);
  context_.addKept(state);
  if (!context_.hasMaps()) return state;
  for (PhotonSystem* system : {&caustic_, &global_}) system->addKept(state, context_.parameters);
  cache_.addKept(state);
  return state;
}

void Renderer::prepareState(int passes) {
  if (cache_.isUsed()) cache_.prepareFor(passes);
}

void Renderer::stateRestored(int passes) {
  for (PhotonSystem* system : {&global_, &caustic_}) system->restored(passes);
}

std::uint64_t Renderer::fingerprint() const {
  const gpu::DeviceInfo& device = context_.device->context.info();
  ContentHash hash;
  hash.add(fmt::format("{} {} {} {}", imageFingerprint(context_.job, context_.scene), context_.job.seed, device.name,
                       device.driver));
  return hash.value();
}

FilmLayers Renderer::resolve(const FilmSums& film) const {
  return resolveFilm(film.halves, {static_cast<int>(context_.parameters.width), film.counts(),
                                   context_.job.sharesLight && context_.hasMaps(), context_.job.threads});
}

Image Renderer::image(const FilmLayers& layers) const {
  const Parameters& p = context_.parameters;
  Image image{static_cast<int>(p.width), static_cast<int>(p.height), {}, {}};
  if (context_.job.crop)
    image.whole = {static_cast<int>(p.imageSize.x), static_cast<int>(p.imageSize.y), static_cast<int>(p.filmCorner.x),
                   static_cast<int>(p.filmCorner.y)};
  addColor(image, "", layers.total);
  if (context_.job.isTransparent) image.channels.push_back({"A", layers.coverage});
  return image;
}

Image Renderer::imageWithLayers(const FilmLayers& layers) {
  Image image = this->image(layers);
  addAovs(context_, camera_, eyeMaps(), caustic_, global_, layers, image);
  return image;
}

RenderStats Renderer::finish(int passes) {
  totals_.finish(passes, caustic_, global_, cache_);
  return stats_;
}

}  // namespace importon
