// Guided scattering: shares that are never zero, the mean of scattering by the material alone, also where nothing was
// learned, and more photons where the camera looks.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "render/guiding/scatter_guide.h"
#include "render_helper.h"

namespace importon::test {
namespace {

constexpr std::size_t kBins = std::size_t{kScatterBins} * kScatterBins;

TEST(ScatterCell, GuidesNothingWhereNothingWasLearned) {
  const std::vector<float> cell = scatterCellOf(std::vector<double>(kBins), GuideWeight::importance);
  EXPECT_EQ(cell, std::vector<float>(kBins + 1));
}

TEST(ScatterCell, FollowsWhatWasLearnedAndLeavesNoBinOut) {
  std::vector<double> sums(kBins);
  sums[27] = 100 * kGuideUnits;
  const std::vector<float> cell = scatterCellOf(sums, GuideWeight::potential);
  EXPECT_EQ(cell.size(), kBins + 1);
  EXPECT_EQ(cell[0], 0.75f);
  EXPECT_EQ(cell[kBins], 1);
  const double even = 16.0 / 116 / kBins;  // for 16 importons that none were, beside 100 that were
  for (std::size_t bin = 1; bin < kBins; ++bin) EXPECT_GE(cell[bin + 1] - cell[bin], 0.999 * even);
  EXPECT_NEAR(cell[28] - cell[27], even + 100.0 / 116 / 2, 1e-6) << "half of it, the rest to its neighbours";
}

TEST(ScatterCell, FollowsTheRootOfImportanceUnlessItIsPotential) {
  std::vector<double> sums(kBins);
  sums[9] = 1e6 * kGuideUnits;
  sums[54] = 4e6 * kGuideUnits;
  const auto ratio = [&](GuideWeight weight) {
    const std::vector<float> cell = scatterCellOf(sums, weight);
    return (cell[55] - cell[54]) / (cell[10] - cell[9]);
  };
  EXPECT_NEAR(ratio(GuideWeight::importance), 2, 1e-3);
  EXPECT_NEAR(ratio(GuideWeight::potential), 4, 1e-3);
}

class Scatter : public RenderTest {};

/// Under a smooth interface, so that some light is mirrored.
Material varnish() {
  Material material = diffuse(vec3(0.3f, 0.6f, 0.5f));
  material.specular = 1;
  material.roughness = 0;
  return material;
}

/// Two rooms and a doorway between them with a varnished ball in it; the lamp in one, the camera looking at the floor
/// of the other.
Scene rooms() {
  SceneBuilder builder;
  const uint white = builder.material(diffuse(vec3(0.7f)));
  builder.box(white, {-2, -1, -1}, {2, 1, 1}, Facing::inside);
  builder.box(white, {-0.1, -1.01, -1.01}, {0.1, 1.01, 0.3}, Facing::outside);
  builder.icosphere(builder.material(varnish()), {0, -0.7, 0.6}, 0.25, 2, Facing::outside, Shading::smooth);
  builder.square(builder.material(emitter(vec3(20))), {1.3, 0.98, -0.2}, {0, -1, 0}, 0.3);
  builder.camera({-1, 0.2, 0.9}, {-1, -1, -0.2}, 0.8, 12, 12);
  return builder.finish();
}

RenderJob scatterJob(ScatterChoice scatter) {
  RenderJob job = makeJob(Integrator::photon, 2);
  job.photons = 1u << 16;
  job.importons = 1u << 12;
  job.gather = 32;
  job.emission = EmissionChoice::power;
  job.scatter = scatter;
  job.guideWeight = GuideWeight::potential;
  return job;
}

TEST_F(Scatter, KeepsTheMeanOfScatteringByTheMaterial) {
  const Scene scene = rooms();
  std::array<Moments, 2> flux, image, density;
  for (const ScatterChoice scatter : {ScatterChoice::material, ScatterChoice::guided}) {
    const auto way = static_cast<std::size_t>(scatter);
    RenderJob job = scatterJob(scatter);
    job.control = DensityControl::off;
    job.gatherFrom = GatherSource::photons;
    job.aovs = {"density.global"};
    for (job.seed = 1; job.seed <= 8; ++job.seed) {
      const Rendered rendered = renderScene(job, scene);
      flux[way].add(rendered.stats.global.fluxHits[1]);
      image[way].add(meanOf(rendered.image, "G"));
      density[way].add(meanOf(rendered.image, "density.global.Y"));
    }
  }
  EXPECT_TRUE(areWithin(0.02, flux[1], flux[0]));
  EXPECT_TRUE(areWithin(0.05, image[1], image[0]));
  EXPECT_GT(density[1].mean(), 1.5 * density[0].mean()) << "the guide brings no more photons to what is seen";
}

TEST_F(Scatter, GivesTheSameBitsAgain) {
  const RenderJob job = scatterJob(ScatterChoice::guided);
  const Image first = renderScene(job, rooms()).image;
  EXPECT_TRUE(haveSameBits(first, renderScene(job, rooms()).image));
}

}  // namespace
}  // namespace importon::test
