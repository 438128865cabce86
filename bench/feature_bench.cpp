// What leaving out saves: the box of Cornell, which has no glass, textures or environment, with the features
// that it needs and with all of them.
#include <benchmark/benchmark.h>

#include <atomic>
#include <filesystem>

#include "render/render.h"
#include "scene/gltf_loader.h"

namespace {

using namespace importon;

constexpr int kPasses = 4;

RenderStats renderOnce(const Scene& scene, Integrator integrator, bool isFull) {
  RenderJob job;
  job.width = job.height = 256;
  job.passes = kPasses;
  job.integrator = integrator;
  job.forcesAllFeatures = isFull;
  Log log(Log::Verbosity::quiet);
  const std::atomic<bool> isInterrupted = false;
  return render(
             job, scene, log, isInterrupted, [](const RenderProgress&) {}, std::chrono::steady_clock::now())
      .stats;
}

void renderBox(benchmark::State& state, Integrator integrator, bool isFull) {
  Log log(Log::Verbosity::quiet);
  const Scene scene = loadGltf(std::filesystem::path(IMPORTON_SCENES) / "cornell_box" / "cornell_box.gltf", log);
  for ([[maybe_unused]] auto _ : state) {
    const RenderStats stats = renderOnce(scene, integrator, isFull);
    double kernels = 0;
    for (const KernelStats& kernel : stats.kernels) kernels += kernel.milliseconds;
    state.counters["kernel_ms_per_pass"] = kernels / kPasses;
    state.counters["start_ms"] = 1000 * stats.seconds.device;
    state.counters["device_MiB"] = static_cast<double>(stats.devicePeakBytes) / (1 << 20);
  }
}

BENCHMARK_CAPTURE(renderBox, photon_minimal, Integrator::photon, false)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(renderBox, photon_full, Integrator::photon, true)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(renderBox, path_minimal, Integrator::path, false)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(renderBox, path_full, Integrator::path, true)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
