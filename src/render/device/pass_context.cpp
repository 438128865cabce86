#include "render/device/pass_context.h"

#include <fmt/format.h>

#include <cmath>
#include <future>

#include "base/clock.h"
#include "render/device_scene/instances.h"
#include "render/device_scene/media.h"

namespace importon {
namespace {

/// Low word in x.
uvec2 wordsOf(std::uint64_t n) { return {static_cast<uint>(n), static_cast<uint>(n >> 32)}; }

void setPhotons(MapSettings& map, std::uint32_t perPass, const PassSums::Photons& before, bool isCounted) {
  map.photonsPerPass = perPass;
  map.firstPhoton = wordsOf(before.shot);
  map.photonsCounted = 0;
  if (before.counted == 0 || perPass == 0) return;
  map.photonsCounted = static_cast<float>(static_cast<double>(before.counted + (isCounted ? perPass : 0)) / perPass);
}

}  // namespace

std::shared_ptr<const Bvh> buildSceneBvh(const Scene& scene, const RenderJob& job, Log& log, double& seconds) {
  const Clock::time_point start = Clock::now();
  const auto progress = [&](double fraction) {
    if (secondsSince(start) > 1) log.progress(fmt::format("building the BVH: {:.0f} %", 100 * fraction));
  };
  auto bvh = std::make_shared<const Bvh>(buildSceneTree(scene, {job.threads, progress}));
  log.endProgress();
  seconds = secondsSince(start);
  return bvh;
}

struct PassContext::Loaded {
  FilmPlace film;
  FeatureSet features;
  std::shared_ptr<LoadedDevice> device;
  DeviceScene scene;
};

PassContext::Loaded PassContext::load(const RenderJob& j, const Scene& s, Log& l, PhaseSeconds& seconds,
                                      const RenderSources& sources) {
  Loaded loaded;
  const Camera& camera = chooseCamera(s, j);
  loaded.film = placeFilm(camera, j);
  (void)chooseLens(camera, j);  // what it throws need not wait for the device
  loaded.features = findFeatures(s, j);
  // The device and its kernels come up while the tree is built.
  auto loading = std::async(std::launch::async, [&] {
    const Clock::time_point start = Clock::now();
    loaded.device = sources.device(loaded.features, j);
    seconds.device = secondsSince(start);
  });
  const std::shared_ptr<const Bvh> bvh = sources.tree ? sources.tree() : buildSceneBvh(s, j, l, seconds.bvh);
  loading.get();
  const Clock::time_point start = Clock::now();
  loaded.scene = uploadScene(loaded.device->context, s, *bvh);
  warnOfMedia(s.materials, l);
  seconds.device += secondsSince(start);
  return loaded;
}

PassContext::PassContext(const RenderJob& j, const Scene& s, Log& l, RenderStats& st, const RenderSources& sources)
    : PassContext(j, s, l, st, load(j, s, l, st.seconds, sources)) {}

PassContext::PassContext(const RenderJob& j, const Scene& s, Log& l, RenderStats& st, Loaded loaded)
    : job(j),
      scene(s),
      log(l),
      stats(st),
      features(loaded.features),
      device(std::move(loaded.device)),
      deviceScene(std::move(loaded.scene)),
      plan(planPasses(job, features, loaded.film.size, device->context.limits())),
      now(plan.whole),
      parameters(makeParameters(job, scene, plan, loaded.film)),
      work(device->context, plan.workspace),
      recorder(device->context) {
  upload();  // layers of an image without a pass need them
}

float PassContext::meanImportance() const {
  return static_cast<float>(parameters.width) * static_cast<float>(parameters.height) /
         static_cast<float>(deviceScene.area);
}

void PassContext::setPass(int pass, const PassSums& before) {
  parameters.pass = static_cast<uint>(pass);
  parameters.densityScale = static_cast<float>(std::cbrt(pass + 1.0));  // r² shrinks as its inverse
  parameters.firstSample = wordsOf(before.evenSamples + before.oddSamples);
  for (const MapKind kind : kMapKinds)
    setPhotons(parameters.*traitsOf(kind).settings, now.photonsFor(kind), before.of(kind),
               parameters.pass < kCountingPasses);
}

void PassContext::begin() {
  upload();
  recorder.fill(work.counters, 0);
}

void PassContext::beginPilot() {
  setPass(0, {});
  begin();
}

}  // namespace importon
