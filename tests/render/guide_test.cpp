// Guided emission: shares that are never zero, the mean of power emission, and more photons where the camera looks.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "render/guiding/emission_guide.h"
#include "render_helper.h"
#include "support/scene_builder.h"
#include "support/statistics.h"

namespace importon::test::guide_test {
namespace {

TEST(GuidePmf, FollowTheRootOfWhatWasLearnedAndAreNeverZero) {
  const int bins = 8;
  std::vector<double> moments(2 * 64);
  moments[64 + 27] = 100;  // all from one direction of the second light
  const GuidePmf shares = chooseGuidePmf(moments, moments, {0.999999, 1e-6}, bins, GuideWeight::importance);
  EXPECT_NEAR(std::accumulate(shares.cells.begin(), shares.cells.end(), 0.0), 1, 1e-12);
  for (const double share : shares.cells) EXPECT_GE(share, 0.075 / 128);
  EXPECT_EQ(std::max_element(shares.cells.begin(), shares.cells.end()) - shares.cells.begin(), 64 + 27);
  EXPECT_EQ(shares.defensiveWeight, 0.15);
  EXPECT_GT(shares.gain, 1e6);
}

TEST(GuidePmf, OfNothingLearnedAreNearlyByPower) {
  const std::vector<double> cells = guidePmf(std::vector<double>(32), {0.75, 0.25}, 4, GuideWeight::importance, 0.15);
  const auto expected = [](double power) { return 0.925 * power + 0.075 / 32; };
  EXPECT_NEAR(cells.front(), expected(0.75 / 16), 1e-15);
  EXPECT_NEAR(cells.back(), expected(0.25 / 16), 1e-15);
  const GuidePmf chosen =
      chooseGuidePmf(std::vector<double>(32), std::vector<double>(32), {0.75, 0.25}, 4, GuideWeight::importance);
  EXPECT_EQ(chosen.gain, 1);
}

TEST(GuidePmf, StayOffWhereTheHalvesAgreeOnNothing) {
  std::vector<double> even(64), odd(64);
  for (std::size_t cell = 0; cell < 64; ++cell) (cell % 8 < 4 ? even : odd)[cell] = 1;
  const GuidePmf shares = chooseGuidePmf(even, odd, {1}, 8, GuideWeight::importance);
  EXPECT_EQ(shares.defensiveWeight, 1);
  EXPECT_NEAR(shares.gain, 1, 1e-12) << "with one light, by power and evenly are the same";
  for (const double share : shares.cells) EXPECT_NEAR(share, 1.0 / 64, 1e-15);
}

TEST(GuidePmf, OfPotentialFollowWhatWasLearnedItself) {
  std::vector<double> moments(2 * 64);
  moments[27] = 1;
  moments[64 + 27] = 9;
  const auto ratio = [&](GuideWeight weight) {
    const std::vector<double> cells = guidePmf(moments, {0.5, 0.5}, 8, weight, 0.15);
    return (cells[64 + 27] - cells[0]) / (cells[27] - cells[0]);
  };
  EXPECT_NEAR(ratio(GuideWeight::importance), 3, 1e-9);
  EXPECT_NEAR(ratio(GuideWeight::potential), 9, 1e-9);
}

class Guide : public RenderTest {};

/// A room with a glass ball and a mirror ball, a lamp, and a parallel light of which a little comes in through a hole
/// in the roof. The camera sees the floor by the glass ball alone.
Scene room() {
  SceneBuilder builder;
  const uint white = builder.material(diffuse(vec3(0.6f)));
  builder.box(white, {-1, -1, -1}, {1, 1, 1}, Facing::inside);
  builder.square(builder.material(emitter(vec3(40))), {0.2, 0.98, 0.1}, {0, -1, 0}, 0.2);
  builder.icosphere(builder.material(glass(1.5f)), {-0.3, -0.6, 0.1}, 0.3, 3, Facing::outside, Shading::smooth);
  builder.icosphere(builder.material(mirror(vec3(0.9f))), {0.5, -0.6, -0.3}, 0.25, 3, Facing::outside, Shading::smooth);
  builder.pointLight({0.7, 0.5, -0.7}, vec3(0.2f));
  builder.directionalLight({0.1, -1, 0.2}, vec3(1));
  builder.camera({-0.3, 0, 0.9}, {-0.35, -1, 0.05}, 0.6, 24, 24);
  return builder.finish();
}

RenderJob guideJob(EmissionChoice emission, GuideWeight weight) {
  RenderJob job = makeJob(Integrator::photon, 2);
  job.photons = 1u << 13;
  job.importons = 1u << 12;
  job.gather = 1;
  job.emission = emission;
  job.guideWeight = weight;
  return job;
}

/// What photons of ten seeds bring, and how many of a thousand meet the glass.
struct FluxFound {
  Moments caustic, global;
  double hits = 0;
};

FluxFound fluxOf(RenderJob job, const Scene& scene) {
  FluxFound found;
  for (job.seed = 1; job.seed <= 10; ++job.seed) {
    const RenderStats stats = renderScene(job, scene).stats;
    found.caustic.add(stats.caustic.fluxHits[1]);
    found.global.add(stats.global.fluxHits[1]);
    found.hits += 100.0 * static_cast<double>(stats.caustic.hits) / *job.photons;
  }
  return found;
}

void expectTheFluxOfPowerEmission(GuideWeight weight) {
  const Scene scene = room();
  RenderJob byPower = guideJob(EmissionChoice::power, weight), guided = guideJob(EmissionChoice::guided, weight);
  byPower.photons = 1u << 17;  // more, as they seldom meet the glass
  guided.photons = 1u << 16;
  const FluxFound expected = fluxOf(byPower, scene), found = fluxOf(guided, scene);
  EXPECT_TRUE(areWithin(0.05, found.caustic, expected.caustic));
  EXPECT_TRUE(areWithin(0.02, found.global, expected.global));
  EXPECT_GT(found.hits, 2 * expected.hits) << "the guide sends no more photons to the glass";
}

TEST_F(Guide, KeepsTheMeanFluxOfPowerEmission) {
  const StabilityCase listed(37, "guided against power emission", "the same mean");
  expectTheFluxOfPowerEmission(GuideWeight::importance);
}

TEST_F(Guide, KeepsTheMeanFluxOfPowerEmissionByDeficits) { expectTheFluxOfPowerEmission(GuideWeight::deficit); }

TEST_F(Guide, FollowsDeficitsOtherwiseThanImportance) {
  const Scene scene = room();
  RenderJob job = guideJob(EmissionChoice::guided, GuideWeight::importance);
  job.photons = 1u << 14;
  const std::uint64_t hits = renderScene(job, scene).stats.caustic.hits;
  job.guideWeight = GuideWeight::deficit;
  EXPECT_NE(renderScene(job, scene).stats.caustic.hits, hits) << "deficits make no difference";
}

}  // namespace
}  // namespace importon::test::guide_test
