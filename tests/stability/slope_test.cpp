// How fast the error falls with the passes: at least as for independent samples, passes^-1, and where the radius of
// lookups shrinks, passes^(-2/3) [Knaus and Zwicker 2011]; one low-discrepancy sequence through all passes makes it
// faster where light is smooth. An error that stalls at a floor fails.
#include <cmath>
#include <map>

#include "render_helper.h"

namespace importon::test::slope_test {
namespace {

constexpr int kSize = 16, kSeeds = 8;

class ErrorSlopes : public RenderTest {
 protected:
  /// Slope of log MSE against log passes from `first` to `last` passes, by least squares, over kSeeds renders.
  [[nodiscard]] static double slope(RenderJob job, const Scene& scene, int first, int last, double expected) {
    std::map<int, double> errors;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      job.seed = static_cast<std::uint32_t>(seed);
      job.passes = last;
      Log log(Log::Verbosity::quiet);
      const std::atomic<bool> isInterrupted = false;
      const auto measure = [&](const RenderProgress& progress) {
        if (progress.pass < first || (progress.pass & (progress.pass - 1)) != 0) return;
        const std::vector<float> values = valuesOf(progress.image());
        for (std::size_t i = 0; i < values.size(); ++i) {
          const double off = static_cast<double>(values[i]) - expected;
          errors[progress.pass] += off * off;
        }
      };
      (void)render(job, scene, log, isInterrupted, measure, std::chrono::steady_clock::now());
    }
    double sumX = 0, sumY = 0, sumXX = 0, sumXY = 0;
    const auto n = static_cast<double>(errors.size());
    for (const auto& [passes, error] : errors) {
      const double x = std::log(static_cast<double>(passes)), y = std::log(error);
      sumX += x;
      sumY += y;
      sumXX += x * x;
      sumXY += x * y;
    }
    return (n * sumXY - sumX * sumY) / (n * sumXX - sumX * sumX);
  }
};

/// A floor that parallel light reaches through glass of index 1 alone, so that the caustic map is all that is seen.
TEST_F(ErrorSlopes, SlowOfTheCausticMapIsTwoThirdsAtLeast) {
  StabilityCase listed(35, "a caustic map seen directly, 4 to 64 passes", "MSE falls at least as passes^(-2/3 + 0.1)");
  SceneBuilder builder;
  builder.square(builder.material(diffuse(vec3(1.0f))), {0, 0, 0}, {0, 1, 0}, 4);
  builder.box(builder.material(glass(1.0f)), {-3, -1, -3}, {3, 1, 3}, Facing::outside);
  builder.directionalLight({0, -1, 0}, vec3(1.0f));
  builder.camera({0, 0.8, 0}, {0, 0, 0}, 0.8, kSize, kSize, {0, 0, 1});
  RenderJob job = makeJob(Integrator::photon, 1);
  job.photons = 1u << 12;
  const double found = slope(job, builder.finish(), 4, 64, 1 / 3.14159265358979);
  EXPECT_LE(found, -2.0 / 3 + 0.1);
  listed.note("slope " + std::to_string(found), 1);
}

/// A closed room whose walls glow and reflect: L = 2.
Scene glowingRoom() {
  SceneBuilder builder;
  builder.box(builder.material(emitter(vec3(1.0f), false, vec3(0.5f))), {-1, -1, -1}, {1, 1, 1}, Facing::inside);
  builder.camera({0.1, 0.2, 0.9}, {-0.1, -0.3, -1}, 1.3, kSize, kSize);
  return builder.finish();
}

TEST_F(ErrorSlopes, SlowOfThePathTracerIsOneAtLeast) {
  StabilityCase listed(35, "paths in a glowing room, 4 to 256 passes", "MSE falls at least as passes^(-1 + 0.1)");
  RenderJob job = makeJob(Integrator::path, 1);
  job.maxDepth = 40;
  const double found = slope(job, glowingRoom(), 4, 256, 2);
  EXPECT_LE(found, -1 + 0.1);
  listed.note("slope " + std::to_string(found), 1);
}

/// The same room by gathering from surface cells, under density control and with gathers shared among pixels.
TEST_F(ErrorSlopes, SlowOfTheDefaultImageDoesNotStall) {
  StabilityCase listed(35, "gathering from cells in a glowing room, 4 to 64 passes",
                       "MSE falls at least as passes^(-2/3 + 0.1)");
  RenderJob job = makeJob(Integrator::photon, 1);
  job.maxDepth = 40;
  job.sharesLight = true;
  const double found = slope(job, glowingRoom(), 4, 64, 2);
  EXPECT_LE(found, -2.0 / 3 + 0.1);
  listed.note("slope " + std::to_string(found), 1);
}

/// Walls lie where voxels of seen lights would meet, were these not shifted: 1 + 0.5 is emitted and reflected once.
TEST_F(ErrorSlopes, OfDirectLightDoNotEndAtABias) {
  const StabilityCase listed(58, "direct light in a closed room whose walls glow", "L = 1.5");
  Moments means;
  for (std::uint32_t seed = 1; seed <= 8; ++seed) {
    RenderJob job = makeJob(Integrator::photon, 8, seed);
    job.aovs = {"direct"};
    means.add(momentsOf(renderScene(job, glowingRoom()).image.find("direct.G")->values).mean());
  }
  EXPECT_TRUE(isWithin(0.005, means, 1.5));
}

}  // namespace
}  // namespace importon::test::slope_test
