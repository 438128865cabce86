// What changes from pass to pass and from seed to seed: random numbers, and the density that photons are stored
// at.
#include <atomic>
#include <chrono>
#include <cmath>

#include "render_helper.h"

namespace importon::test::passes_test {
namespace {

class Passes : public RenderTest {};

/// A box lit by a lamp under its ceiling.
Scene litBox() {
  SceneBuilder builder;
  builder.box(builder.material(diffuse(vec3(0.6f))), {-1, -1, -1}, {1, 1, 1}, Facing::inside);
  builder.square(builder.material(emitter(vec3(10))), {0, 0.9, 0}, {0, -1, 0}, 0.4);
  builder.camera({0, 0, 0.9}, {0, -0.3, -1}, 1.0, 8, 8);
  return builder.finish();
}

RenderJob photonJob(int passes, std::uint32_t seed = 1) {
  RenderJob job = makeJob(Integrator::photon, passes, seed);
  job.photons = 1u << 12;
  job.gatherFrom = GatherSource::photons;
  return job;
}

TEST_F(Passes, OfOtherSeedsShootOtherPhotonsAndTraceOtherPaths) {
  const Scene scene = litBox();
  const auto power = [&](std::uint32_t seed) { return renderScene(photonJob(1, seed), scene).stats.global.fluxHits; };
  EXPECT_NE(power(1), power(2));
  const auto paths = [&](std::uint32_t seed) { return renderScene(makeJob(Integrator::path, 1, seed), scene).image; };
  EXPECT_FALSE(haveSameBits(paths(1), paths(2)));
}

// With the photons of the first pass once more, hits would double; with its camera paths, the mean would stay.
TEST_F(Passes, ShootOtherPhotonsAndTraceOtherPathsThanTheOneBefore) {
  const Scene scene = litBox();
  EXPECT_NE(renderScene(photonJob(2), scene).stats.global.hits, 2 * renderScene(photonJob(1), scene).stats.global.hits);
  EXPECT_FALSE(haveSameBits(renderScene(makeJob(Integrator::path, 2), scene).image,
                            renderScene(makeJob(Integrator::path, 1), scene).image));
}

// As Ctrl-C while importance is found.
TEST_F(Passes, InterruptedBeforeTheFirstOneGiveABlackImage) {
  const Scene scene = litBox();
  const std::atomic<bool> isInterrupted = true;
  for (const Integrator integrator : {Integrator::photon, Integrator::path})
    for (const GatherSource source : {GatherSource::cells, GatherSource::photons}) {
      RenderJob job = makeJob(integrator, 1);
      job.gatherFrom = source;
      job.aovs = {"albedo", "importance.global", "radiance.global", "photons.global"};
      Log log(Log::Verbosity::quiet);
      const RenderResult result = render(
          job, scene, log, isInterrupted, [](const RenderProgress&) {}, std::chrono::steady_clock::now());
      EXPECT_TRUE(result.wasInterrupted);
      for (const float value : valuesOf(result.image)) ASSERT_EQ(value, 0.0f);
      EXPECT_GT(meanOf(result.image, "albedo.R"), 0);
    }
}

// So r² shrinks as its inverse. Of eight passes the mean of the cube roots is 1.59.
TEST_F(Passes, StoreAtADensityThatGrowsByTheCubeRootOfTheirNumber) {
  const Scene scene = litBox();
  const auto stored = [&](int passes) {
    RenderJob job = photonJob(passes);
    job.photons = 1u << 16;
    job.constantDensity = 20;
    return static_cast<double>(renderScene(job, scene).stats.global.stored) / passes;
  };
  double mean = 0;
  for (int pass = 1; pass <= 8; ++pass) mean += std::cbrt(pass) / 8;
  EXPECT_NEAR(stored(8) / stored(1), mean, 0.1);
}

}  // namespace
}  // namespace importon::test::passes_test
