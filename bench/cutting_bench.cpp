// What cutting long diagonal triangles brings to rays: the time with the cut tree over that with the whole one, of the
// scenes as they are and turned so that their walls lie along no axis. The trees take turns. IMPORTON_BENCH_DEVICE as
// in traversal_bench.cpp.
#include <benchmark/benchmark.h>

#include <array>

#include "accel/ray_tracer.h"
#include "base/error.h"
#include "bench/bench_scene.h"
#include "gpu/context.h"

namespace {

using namespace importon;
using namespace importon::bench;

constexpr std::size_t kRays = 1000000;
constexpr int kRounds = 9;

/// Median of the device time through `cut` over that through `whole`.
double timeRatio(test::RayTracer& cut, test::RayTracer& whole, std::span<const Ray> rays, bool isAnyHit) {
  std::array<std::vector<double>, 2> seconds;
  for (test::RayTracer* tracer : {&cut, &whole}) {
    tracer->upload(rays);
    tracer->trace(isAnyHit);  // compiles the kernel
  }
  for (int round = 0; round < kRounds; ++round) {
    cut.trace(isAnyHit);
    seconds[0].push_back(cut.seconds());
    whole.trace(isAnyHit);
    seconds[1].push_back(whole.seconds());
  }
  return median(seconds[0]) / median(seconds[1]);
}

void measureCutting(benchmark::State& state, const BenchScene& scene) {
  const Bvh cut = buildBvh(scene.positions, scene.triangles);
  const Bvh whole = buildBvh(scene.positions, scene.triangles, {.threads = 0, .progress = {}, .splits = false});
  const bool isSameTree = cut.nodes == whole.nodes;
  double closest = 1, any = 1;
  for ([[maybe_unused]] auto _ : state) {
    if (isSameTree) continue;
    gpu::Context context({.device = setting("IMPORTON_BENCH_DEVICE")});
    test::RayTracer cutTracer(context, cut), wholeTracer(context, whole);
    closest = timeRatio(cutTracer, wholeTracer, makeBounceRays(scene, kRays), false);
    any = timeRatio(cutTracer, wholeTracer, makeShadowRays(scene, kRays), true);
  }
  state.counters["records"] = static_cast<double>(cut.nodes.size()) / static_cast<double>(whole.nodes.size());
  state.counters["is_same_tree"] = isSameTree ? 1 : 0;
  state.counters["closest"] = closest;
  state.counters["any_hit"] = any;
}

const int kRegistered = [] {
  for (const bool isTurned : {false, true})
    for (const char* name : benchSceneNames())
      benchmark::RegisterBenchmark((std::string("cutting/") + name + (isTurned ? "_turned" : "")).c_str(),
                                   [name, isTurned](benchmark::State& state) {
                                     try {
                                       BenchScene scene = loadBenchScene(name);
                                       measureCutting(state, isTurned ? turned(std::move(scene)) : scene);
                                     } catch (const Error& error) {
                                       state.SkipWithError(error.what());
                                     }
                                   })
          ->Iterations(1)
          ->Unit(benchmark::kMillisecond);
  return 0;
}();

}  // namespace
