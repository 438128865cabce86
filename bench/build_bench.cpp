// Time to build the BVH, and its ratio to Embree's, measured in turns.
#include <benchmark/benchmark.h>

#include <chrono>
#include <vector>

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

/// In turns with Embree, so that what else the machine does disturbs both alike.
void measureBuild(benchmark::State& state, const BenchScene& scene) {
  std::size_t bytes = 0;
  std::vector<double> seconds, processor, embreeSeconds, embreeProcessor;
  for ([[maybe_unused]] auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    const double processorStart = processorSeconds();
    {
      const Bvh bvh = buildBvh(scene.positions, scene.triangles);
      bytes = bvh.nodes.size() * sizeof(BvhRecord);
    }
    processor.push_back(processorSeconds() - processorStart);
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    state.SetIterationTime(seconds.back());
#ifdef IMPORTON_HAS_EMBREE
    const EmbreeScene embree(scene, threadCount(0));
    embreeSeconds.push_back(embree.buildSeconds());
    embreeProcessor.push_back(embree.buildProcessorSeconds());
#endif
  }
  state.counters["triangles"] = static_cast<double>(scene.triangles.size());
  state.counters["bytes/triangle"] = static_cast<double>(bytes) / static_cast<double>(scene.triangles.size());
  state.counters["median_ms"] = 1e3 * median(seconds);
#ifdef IMPORTON_HAS_EMBREE
  state.counters["Embree_ms"] = 1e3 * median(embreeSeconds);
  state.counters["ratio"] = median(seconds) / median(embreeSeconds);
  state.counters["processor_ratio"] = median(processor) / median(embreeProcessor);
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
        ->UseManualTime();
  return 0;
}();

}  // namespace
