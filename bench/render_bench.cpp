// How fast the phases of a pass are: photons, importons and gather paths per second, from the renderer's own counts
// and clocks, with kernels warm.
#include <benchmark/benchmark.h>

#include <atomic>
#include <filesystem>

#include "render/render.h"
#include "scene/gltf_loader.h"

namespace {

using namespace importon;

constexpr int kSize = 256;  // pixels
constexpr int kPasses = 4;

RenderStats renderOnce(const Scene& scene, int passes) {
  RenderJob job;
  job.width = kSize;
  job.height = kSize;
  job.passes = passes;
  Log log(Log::Verbosity::quiet);
  const std::atomic<bool> isInterrupted = false;
  return render(
             job, scene, log, isInterrupted, [](const RenderProgress&) {}, std::chrono::steady_clock::now())
      .stats;
}

void renderPasses(benchmark::State& state, const std::string& name) {
  Log log(Log::Verbosity::quiet);
  const Scene scene = loadGltf(std::filesystem::path(IMPORTON_SCENES) / name / (name + ".gltf"), log);
  (void)renderOnce(scene, 1);  // the driver compiles kernels at their first use
  double photons = 0, photonSeconds = 0, importons = 0, importanceSeconds = 0, gathers = 0, gatherSeconds = 0;
  for ([[maybe_unused]] auto _ : state) {
    const RenderStats stats = renderOnce(scene, kPasses);
    photons += static_cast<double>(stats.photonsEmitted);
    photonSeconds += stats.seconds.photons;
    importons += static_cast<double>(stats.importonsEmitted);
    importanceSeconds += stats.seconds.importance;
    gathers += static_cast<double>(kSize) * kSize * kPasses;
    gatherSeconds += stats.seconds.gather;
  }
  state.counters["photons/s"] = photons / photonSeconds;
  state.counters["importons/s"] = importons / importanceSeconds;
  state.counters["gather_paths/s"] = gathers / gatherSeconds;
}

const int kRegistered = [] {
  for (const char* name : {"cornell_box", "door_slit", "rooms", "glass_caustic", "ring", "pool"})
    benchmark::RegisterBenchmark((std::string("passes/") + name).c_str(), [name](benchmark::State& state) {
      renderPasses(state, name);
    })->Unit(benchmark::kMillisecond);
  return 0;
}();

}  // namespace
