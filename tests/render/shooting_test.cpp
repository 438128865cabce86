// Shooting as many photons as important places require: when it is enough, and that the image's mean does not know.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "render/importance/site_hits.h"
#include "render_helper.h"

namespace importon::test::shooting_test {
namespace {

TEST(SiteSupply, CountsWhatIsMissingWhereLightComes) {
  const std::array<uint, 4> hits{9, 4, 0, 100}, order{2, 1, 3, 0};
  const std::array<float, 4> asked{10, 16, 10, 50};
  const SiteSupply supply = supplyOf(hits, asked, order);
  EXPECT_DOUBLE_EQ(supply.lit, 0.75);
  EXPECT_DOUBLE_EQ(supply.deficit, (1 - 6.0 / 16) / 3) << "9 ± 3 is no less than 10";
  EXPECT_EQ(supplyOf({}, {}, {}).lit, 0);
}

TEST(SiteSupply, TakesNeighboursTogetherThatAskForLittle) {
  const std::array<uint, 8> hits{0, 0, 3, 0, 0, 0, 0, 0}, order{0, 1, 2, 3, 4, 5, 6, 7};
  const std::array<float, 8> asked{2, 2, 2, 2, 2, 2, 2, 2};
  const SiteSupply supply = supplyOf(hits, asked, order);
  EXPECT_DOUBLE_EQ(supply.lit, 0.5);
  EXPECT_DOUBLE_EQ(supply.deficit, 1 - (3 + std::sqrt(3.0)) / 8);
}

TEST(ShootingRule, GoesOnWhileBatchesLightNewPlaces) {
  ShootingRule rule;
  for (int batch = 1; batch <= 20; ++batch) EXPECT_FALSE(rule.isEnough({0, 0.04 * batch}));
  EXPECT_FALSE(rule.isEnough({0, 0.8}));
  EXPECT_FALSE(rule.isEnough({0, 0.8}));
  EXPECT_TRUE(rule.isEnough({0, 0.8}));
  EXPECT_FALSE(rule.isEnough({0, 0.9})) << "a place far behind a slit was found";
}

TEST(ShootingRule, GoesOnWhilePhotonsAreMissing) {
  ShootingRule rule;
  for (int batch = 0; batch < 20; ++batch) EXPECT_FALSE(rule.isEnough({0.2, 1}));
  EXPECT_TRUE(rule.isEnough({0.01, 1}));
}

class Shooting : public RenderTest {};

constexpr std::uint32_t kMostPhotons = 1u << 14;

/// A room with a lamp; the camera sees a part of its floor.
Scene room() {
  SceneBuilder builder;
  builder.box(builder.material(diffuse(vec3(0.5f))), {-1, -1, -1}, {1, 1, 1}, Facing::inside);
  builder.square(builder.material(emitter(vec3(20))), {0.3, 0.98, 0}, {0, -1, 0}, 0.4);
  builder.camera({0, 0, 0.9}, {0, -1, 0}, 0.7, 24, 24);
  return builder.finish();
}

/// Everywhere `density` photons/m² are asked for.
RenderJob shootingJob(PhotonsShot shooting, double density) {
  RenderJob job = makeJob(Integrator::photon, 2);
  job.photons = kMostPhotons;
  job.importons = 1u << 12;
  job.gather = 1;
  job.constantDensity = density;
  job.shooting = shooting;
  return job;
}

TEST_F(Shooting, OfEnoughPhotonsKeepsTheMean) {
  const Scene scene = room();
  std::array<Moments, 2> image, flux;
  for (const PhotonsShot shooting : {PhotonsShot::all, PhotonsShot::enough}) {
    RenderJob job = shootingJob(shooting, 60);
    const auto way = static_cast<std::size_t>(shooting);
    for (job.seed = 1; job.seed <= 10; ++job.seed) {
      const Rendered rendered = renderScene(job, scene);
      image[way].add(meanOf(rendered.image));
      flux[way].add(rendered.stats.global.fluxHits[0]);
      if (shooting == PhotonsShot::all)
        EXPECT_EQ(rendered.stats.photonsEmitted, 2 * kMostPhotons);
      else
        EXPECT_LT(rendered.stats.photonsEmitted, kMostPhotons);
    }
  }
  EXPECT_TRUE(areWithin(0.02, image[1], image[0]));
  EXPECT_TRUE(areWithin(0.02, flux[1], flux[0]));
}

TEST_F(Shooting, OfEnoughPhotonsIsAllWhereMoreIsRequired) {
  const Rendered enough = renderScene(shootingJob(PhotonsShot::enough, 1e6), room());
  EXPECT_EQ(enough.stats.photonsEmitted, 2 * kMostPhotons);
  EXPECT_TRUE(haveSameBits(enough.image, renderScene(shootingJob(PhotonsShot::all, 1e6), room()).image));
}

TEST_F(Shooting, OfEnoughPhotonsGivesTheSameBitsAgain) {
  const RenderJob job = shootingJob(PhotonsShot::enough, 60);
  const Rendered first = renderScene(job, room()), second = renderScene(job, room());
  EXPECT_EQ(first.stats.photonsEmitted, second.stats.photonsEmitted);
  EXPECT_TRUE(haveSameBits(first.image, second.image));
}

}  // namespace
}  // namespace importon::test::shooting_test
