// What the choice of lights costs, and how much noise it leaves, from hundreds of emissive triangles to a
// million.
#include <benchmark/benchmark.h>

#include <atomic>
#include <cmath>
#include <random>

#include "render/render.h"
#include "support/scene_builder.h"

namespace {

using namespace importon;

constexpr int kSize = 128;  // pixels

/// A floor under small triangles that emit, of very different powers, spread over a slab above it.
Scene floorUnderLights(int count) {
  test::SceneBuilder builder;
  builder.square(builder.material(test::diffuse(vec3(0.7f))), {0, 0, 0}, {0, 1, 0}, 20);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-9, 9), height(0.3, 2), side(-1, 1);
  const uint materials[] = {builder.material(test::emitter(vec3(1.0f))), builder.material(test::emitter(vec3(30.0f)))};
  const double size = 3 / std::sqrt(static_cast<double>(count));
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 p(place(random), height(random), place(random));
    const auto corner = [&] { return p + size * glm::dvec3(side(random), side(random), side(random)); };
    builder.triangle(materials[i % 8 == 0], corner(), corner(), corner());
  }
  builder.camera({0, 0.29, 7}, {0, 0, 6.6}, 0.6, kSize, kSize);  // no light is seen
  return builder.finish();
}

RenderResult renderDirect(const Scene& scene, int passes) {
  RenderJob job;
  job.integrator = Integrator::path;
  job.maxDepth = 1;
  job.passes = passes;
  job.aovs = {"variance"};
  Log log(Log::Verbosity::quiet);
  const std::atomic<bool> isInterrupted = false;
  return render(
      job, scene, log, isInterrupted, [](const RenderProgress&) {}, std::chrono::steady_clock::now());
}

double meanOf(const Image& image, const char* channel) {
  double sum = 0;
  const std::vector<float>& values = image.find(channel)->values;
  for (const float value : values) sum += static_cast<double>(value);
  return sum / static_cast<double>(values.size());
}

void lights(benchmark::State& state) {
  const Scene scene = floorUnderLights(static_cast<int>(state.range(0)));
  (void)renderDirect(scene, 1);  // the driver compiles kernels at their first use
  for ([[maybe_unused]] auto _ : state) {
    const RenderResult result = renderDirect(scene, 8);
    for (const KernelStats& kernel : result.stats.kernels)
      if (kernel.label == "eye scatter") state.counters["shade_ms_per_pass"] = kernel.milliseconds / 8;
    state.counters["relative_noise"] = std::sqrt(8 * meanOf(result.image, "variance.R")) / meanOf(result.image, "R");
  }
}

BENCHMARK(lights)
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10'000)
    ->Arg(100'000)
    ->Arg(1'000'000)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace
