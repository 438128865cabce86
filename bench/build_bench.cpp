// Time to build the BVH, beside Embree's.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "accel/bvh.h"
#include "base/error.h"
#include "base/parallel.h"
#include "bench/bench_scene.h"
#ifdef IMPORTON_HAS_EMBREE
#include "bench/embree_scene.h"
#endif

namespace {

using namespace importon;
using namespace importon::bench;

void measureBuild(benchmark::State& state, const BenchScene& scene) {
  std::size_t bytes = 0;
  for ([[maybe_unused]] auto _ : state) {
    const Bvh bvh = buildBvh(scene.positions, scene.triangles);
    bytes = bvh.nodes.size() * sizeof(BvhRecord);
  }
  state.counters["triangles"] = static_cast<double>(scene.triangles.size());
  state.counters["bytes/triangle"] = static_cast<double>(bytes) / static_cast<double>(scene.triangles.size());
#ifdef IMPORTON_HAS_EMBREE
  double fastest = EmbreeScene(scene, threadCount(0)).buildSeconds();
  for (int i = 0; i < 4; ++i) fastest = std::min(fastest, EmbreeScene(scene, threadCount(0)).buildSeconds());
  state.counters["Embree_ms"] = 1e3 * fastest;
#endif
}

const int kRegistered = [] {
  for (const char* name : benchSceneNames())
    benchmark::RegisterBenchmark((std::string("build/") + name).c_str(),
                                 [name](benchmark::State& state) {
                                   try {
                                     measureBuild(state, loadBenchScene(name));
                                   } catch (const Error& error) {
                                     state.SkipWithError(error.what());
                                   }
                                 })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  return 0;
}();

}  // namespace
