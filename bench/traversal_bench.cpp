// Rays per second of kernels/traversal/trace.comp on a million incoherent rays, or four million on a GPU, and on CPU
// devices the ratio to Embree's, measured in turns. In the environment, IMPORTON_BENCH_DEVICE names the Vulkan device
// as --device does, and IMPORTON_BENCH_WITHOUT_EMBREE leaves out the comparison.
#include <benchmark/benchmark.h>

#include <chrono>
#include <optional>

#include "accel/ray_tracer.h"
#include "base/error.h"
#include "base/parallel.h"
#include "bench/bench_scene.h"
#include "gpu/context.h"
#ifdef IMPORTON_HAS_EMBREE
#include "bench/embree_scene.h"
#endif

namespace {

using namespace importon;
using namespace importon::bench;

constexpr std::size_t kRays = 1000000, kRaysOnGpu = 4000000;

void measureTraversal(benchmark::State& state, const BenchScene& scene, bool isAnyHit) {
  gpu::Context context({.device = setting("IMPORTON_BENCH_DEVICE")});
  const std::size_t count = context.limits().isCpu ? kRays : kRaysOnGpu;
  const std::vector<Ray> rays = isAnyHit ? makeShadowRays(scene, count) : makeBounceRays(scene, count);
  test::RayTracer tracer(context, buildBvh(scene.positions, scene.triangles));
  tracer.upload(rays);
  tracer.trace(isAnyHit);  // compiles the kernel
#ifdef IMPORTON_HAS_EMBREE
  std::optional<EmbreeScene> embree;
  if (context.limits().isCpu && setting("IMPORTON_BENCH_WITHOUT_EMBREE").empty()) embree.emplace(scene, threadCount(0));
  double embreeSeconds = 0, embreeProcessor = 0;
#endif
  double seconds = 0, deviceSeconds = 0, processor = 0;
  for ([[maybe_unused]] auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    const double processorStart = processorSeconds();
    tracer.trace(isAnyHit);
    const double processorMiddle = processorSeconds();
    processor += processorMiddle - processorStart;
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    state.SetIterationTime(elapsed);
    seconds += elapsed;
    deviceSeconds += tracer.seconds();
#ifdef IMPORTON_HAS_EMBREE
    if (!embree) continue;
    embreeSeconds += embree->trace(rays, isAnyHit);
    embreeProcessor += processorSeconds() - processorMiddle;
#endif
  }
  const double traced = static_cast<double>(count) * static_cast<double>(state.iterations());
  if (tracer.unfinished() > 0) state.SkipWithError("rays were given up");
  state.SetLabel(context.info().name);
  state.counters["triangles"] = static_cast<double>(scene.triangles.size());
  state.counters["Mrays/s"] = traced / seconds * 1e-6;
  state.counters["device_Mrays/s"] = traced / deviceSeconds * 1e-6;  // by its own clock
#ifdef IMPORTON_HAS_EMBREE
  if (!embree) return;
  state.counters["Embree_Mrays/s"] = traced / embreeSeconds * 1e-6;
  state.counters["ratio"] = embreeSeconds / seconds;
  // The same by processor time, which other programs on the machine disturb less.
  state.counters["processor_ratio"] = embreeProcessor / processor;
#endif
}

const int kRegistered = [] {
  for (const bool isAnyHit : {false, true})
    for (const char* name : benchSceneNames())
      benchmark::RegisterBenchmark((std::string(isAnyHit ? "any_hit/" : "closest_hit/") + name).c_str(),
                                   [name, isAnyHit](benchmark::State& state) {
                                     try {
                                       measureTraversal(state, loadBenchScene(name), isAnyHit);
                                     } catch (const Error& error) {
                                       state.SkipWithError(error.what());
                                     }
                                   })
          ->Unit(benchmark::kMillisecond)
          ->UseManualTime();
  return 0;
}();

}  // namespace
