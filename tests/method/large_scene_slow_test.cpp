// Large scenes fit in modest memory.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <string>

#include "method/render_scene.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"
#include "support/stability.h"
#include "support/statistics.h"

namespace importon {
namespace {

class LargeScene : public test::GpuTest {};

/// A lit box whose walls are cells x cells quads, 12 cells² triangles.
Scene finelyCutBox(int cells, int width, int height) {
  test::SceneBuilder builder;
  builder.box(builder.material(test::diffuse(vec3(0.7f))), {-1, -1, -1}, {1, 1, 1}, test::Facing::inside, cells);
  builder.square(builder.material(test::emitter(vec3(5))), {0, 0.9, 0}, {0, -1, 0}, 0.5);
  builder.camera({0, 0, 0.9}, {0, 0, 0}, 1.0, width, height);
  return builder.finish();
}

long peakHostMiB() {
  rusage usage{};
  EXPECT_EQ(getrusage(RUSAGE_SELF, &usage), 0);
  return usage.ru_maxrss >> 10;
}

TEST_F(LargeScene, OfAMillionTrianglesRendersWithinTwoGibibytesOfHostAndOneOfDeviceMemory) {
  RenderJob job;
  job.passes = 1;
  const Scene scene = finelyCutBox(290, 640, 480);
  ASSERT_GE(scene.triangles.size(), 1'000'000u);
  const RenderResult result = test::renderScene(scene, job);
  EXPECT_GT(test::meanOf(result), 0);
  EXPECT_LT(result.stats.devicePeakBytes, 1ull << 30);
  EXPECT_LT(peakHostMiB(), 2048);
}

/// The red channel, averaged over blocks to width x height values.
std::vector<double> averagedTo(const RenderResult& result, int width, int height) {
  const std::vector<float>& values = test::channel(result, "R");
  const int step = result.image.width / width;
  std::vector<double> means(static_cast<std::size_t>(width * height));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t x = i % static_cast<std::size_t>(result.image.width),
                      y = i / static_cast<std::size_t>(result.image.width);
    means[y / static_cast<std::size_t>(step) * static_cast<std::size_t>(width) + x / static_cast<std::size_t>(step)] +=
        static_cast<double>(values[i]) / (step * step);
  }
  return means;
}

/// p of the hypothesis that the pixels' differences have the mean 0: of paths, whose pixels are independent.
double equality(const std::vector<double>& a, const std::vector<double>& b) {
  test::Moments differences;
  for (std::size_t i = 0; i < a.size(); ++i) differences.add(a[i] - b[i]);
  return test::tTest(differences, 0).pValue;
}

constexpr double kSignificance = 1e-3;

/// Tree, triangles and vertices are each larger than what a kernel may bind as a storage buffer of lavapipe.
TEST_F(LargeScene, OfTenMillionTrianglesRenders) {
  test::StabilityCase listed(56, "10 million triangles", "the light of 12");
  RenderJob job;
  job.passes = 1;
  job.photons = 1u << 14;
  job.sharesLight = false;
  const Scene scene = finelyCutBox(913, 32, 24);
  ASSERT_GE(scene.triangles.size(), 10'000'000u);
  const RenderResult result = test::renderScene(scene, job);
  EXPECT_TRUE(std::isfinite(test::meanOf(result)));
  EXPECT_EQ(result.stats.global.fluxMap, result.stats.global.fluxHits);
  EXPECT_LT(result.stats.devicePeakBytes, 8ull << 30);
  EXPECT_LT(peakHostMiB(), 16384);
  job.integrator = Integrator::path;
  job.gather = 16;
  const auto image = [&](const Scene& of, std::uint32_t seed) {
    job.seed = seed;
    return averagedTo(test::renderScene(of, job), 32, 24);
  };
  const double p = equality(image(scene, 1), image(finelyCutBox(1, 32, 24), 2));
  EXPECT_GT(p, kSignificance);
  listed.note("tree in " + std::to_string(static_cast<int>(result.stats.seconds.bvh)) + " s, " +
                  std::to_string(result.stats.devicePeakBytes >> 20) + " MiB on the device, " +
                  std::to_string(peakHostMiB()) + " MiB in all",
              1 - std::log(p) / std::log(kSignificance));
}

TEST_F(LargeScene, ImageOf4096By4096PixelsRenders) {
  test::StabilityCase listed(57, "an image of 4096 x 4096 pixels", "the mean of 64 x 64");
  RenderJob job;
  job.passes = 1;
  job.integrator = Integrator::path;
  job.maxDepth = 3;
  const RenderResult large = test::renderScene(finelyCutBox(1, 4096, 4096), job);
  job.seed = 1;
  job.gather = 64;
  const RenderResult small = test::renderScene(finelyCutBox(1, 64, 64), job);
  const double p = equality(averagedTo(large, 64, 64), averagedTo(small, 64, 64));
  EXPECT_GT(p, kSignificance);
  listed.note(std::to_string(large.stats.devicePeakBytes >> 20) + " MiB on the device, " +
                  std::to_string(peakHostMiB()) + " MiB in all",
              1 - std::log(p) / std::log(kSignificance));
}

}  // namespace
}  // namespace importon
