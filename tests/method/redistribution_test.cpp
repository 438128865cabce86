// Power handed over to stored photons: none is lost, however it is shared out. That none crosses a step of importance
// is shown in importance_step_test.cpp.
#include <gtest/gtest.h>

#include <cmath>

#include "method/map_rig.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"
#include "support/stability.h"

namespace importon::redistribution_test {
namespace {

using test::SceneBuilder;

/// A room with a white box in it, lit by two lamps of different colours.
Scene room() {
  SceneBuilder builder;
  const uint white = builder.material(test::diffuse(vec3(0.75f)));
  builder.box(white, {-1, -1, -1}, {1, 1, 1}, test::Facing::inside);
  builder.box(builder.material(test::diffuse(vec3(0.2f, 0.5f, 0.7f))), {-0.5, -1, -0.5}, {0.1, 0, 0.1},
              test::Facing::outside);
  builder.square(builder.material(test::emitter(vec3(5, 3, 1))), {0.4, 0.99, 0}, {0, -1, 0}, 0.3);
  builder.pointLight({-0.7, 0.7, 0.3}, vec3(0.1f, 0.2f, 0.3f));
  builder.camera({0, 0, 0.9}, {0, 0, 0}, 1.0, 24, 24);
  return builder.finish();
}

/// A beam onto a spot of 1 cm, much smaller than the largest quota radius.
Scene beam() {
  SceneBuilder builder;
  builder.square(builder.material(test::diffuse(vec3(0.5f))), {0, 0, 0}, {0, 1, 0}, 2);
  builder.spotLight({0, 1, 0}, {0, -1, 0}, vec3(3, 2, 1), 0.009, 0.01);
  builder.camera({0, 1, 0}, {0, 0, 0}, 0.5, 16, 16, {0, 0, -1});
  return builder.finish();
}

RenderJob job(std::uint32_t photons, double density) {
  RenderJob made;
  made.passes = 1;
  made.photons = photons;
  made.importons = 1u << 12;
  made.maxDepth = 6;
  made.constantDensity = density;
  return made;
}

class Redistribution : public test::GpuTest {};

TEST_F(Redistribution, KeepsAllPowerForAnyNumberOfReceivers) {
  const Scene scene = room();
  test::MapRig rig(context(), scene, job(1u << 15, 100));
  for (const uint receivers : {0u, 1u, 4u, 20u}) {
    const PhotonMapCounts counts = rig.counts(rig.shoot(MapKind::global, DensityControl::density, receivers));
    EXPECT_TRUE(counts.isEnergyExact) << receivers << " receivers";
    EXPECT_GT(counts.fluxHits[0], 0);
    EXPECT_GT(counts.redistributed, 10 * counts.stored) << "little was redistributed";
    EXPECT_EQ(counts.stored + counts.redistributed, counts.hits);
  }
}

TEST_F(Redistribution, KeepsAllPowerHoweverItIsSharedOutAndHitsAreAccepted) {
  const Scene scene = room();
  test::MapRig rig(context(), scene, job(1u << 14, 100));
  for (const uint shares : {kShareEqual, kShareByDistance, kShareByDirection}) {
    for (const uint acceptance : {kAcceptStep, kAcceptCosine}) {
      const StorageRule rule{DensityControl::density, 20, nullptr, 0, acceptance, shares, 3};
      const PhotonMapCounts counts = rig.counts(rig.shoot(MapKind::global, rule));
      EXPECT_TRUE(counts.isEnergyExact) << "shares " << shares << ", acceptance " << acceptance;
      EXPECT_GT(counts.redistributed, 4 * counts.stored) << "little was redistributed";
    }
  }
}

/// Parallel light from two sides, red and blue, on a square.
Scene twoBeams(const Material& material) {
  SceneBuilder builder;
  builder.square(builder.material(material), {0, 0, 0}, {0, 1, 0}, 2);
  builder.directionalLight(glm::normalize(glm::dvec3(1, -1, 0)), vec3(1, 0, 0));
  builder.directionalLight(glm::normalize(glm::dvec3(-1, -1, 0)), vec3(0, 0, 1));
  builder.camera({0, 1, 0}, {0, 0, 0}, 0.5, 16, 16, {0, 0, -1});
  return builder.finish();
}

/// Mean over the photons of the share of power that came from the other side.
double mixing(test::MapRig& rig, const StorageRule& rule) {
  const PhotonMap map = rig.shoot(MapKind::global, rule);
  EXPECT_LT(4 * rig.counts(map).stored, rig.counts(map).hits) << "little was redistributed";
  const std::vector<vec3> flux = rig.flux(map);
  double sum = 0;
  for (const vec3& f : flux) sum += std::min(f.x, f.z) / (f.x + f.z);
  return sum / static_cast<double>(flux.size());
}

TEST_F(Redistribution, ByDirectionKeepsLightOfOneDirectionTogether) {
  const Scene scene = twoBeams(test::diffuse(vec3(0.5f)));
  test::MapRig rig(context(), scene, job(1u << 15, 500));
  EXPECT_GT(mixing(rig, {DensityControl::density, 8, nullptr, 0, kAcceptStep, kShareEqual, 0}), 0.3);
  // Power mixes only where all receivers are of the other side.
  EXPECT_LT(mixing(rig, {DensityControl::density, 8, nullptr, 0, kAcceptStep, kShareByDirection, 0}), 0.1);
}

TEST_F(Redistribution, OnGlossySurfacesGivesToLightOfLikeDirectionOnly) {
  const Scene scene = twoBeams(test::metal(vec3(0.5f), 0.6f));
  test::MapRig rig(context(), scene, job(1u << 15, 500));
  EXPECT_EQ(mixing(rig, {DensityControl::density, 8, nullptr, 0, kAcceptStep, kShareEqual, 0}), 0);
}

/// Power-weighted mean of the squared distance from the middle, m².
double spread(test::MapRig& rig, uint shares) {
  const PhotonMap map = rig.shoot(MapKind::global, {DensityControl::density, 16, nullptr, 0, kAcceptStep, shares, 0});
  const std::vector<MapPoint> photons = rig.photons(map);
  const std::vector<vec3> flux = rig.flux(map);
  double sum = 0, power = 0;
  for (std::size_t i = 0; i < photons.size(); ++i) {
    sum += flux[i].x * glm::dot(photons[i].position, photons[i].position);
    power += flux[i].x;
  }
  return sum / power;
}

TEST_F(Redistribution, ByDistanceSpreadsPowerLess) {
  SceneBuilder builder;  // a red spot of 1 cm in even white light
  builder.square(builder.material(test::diffuse(vec3(0.5f))), {0, 0, 0}, {0, 1, 0}, 2);
  builder.spotLight({0, 1, 0}, {0, -1, 0}, vec3(6000, 0, 0), 0.009, 0.01);
  builder.directionalLight({0, -1, 0}, vec3(0, 0.5f, 0.5f));
  builder.camera({0, 1, 0}, {0, 0, 0}, 0.5, 16, 16, {0, 0, -1});
  const Scene scene = builder.finish();
  test::MapRig rig(context(), scene, job(1u << 15, 1000));
  EXPECT_LT(spread(rig, kShareByDistance), 0.9 * spread(rig, kShareEqual));
}

TEST_F(Redistribution, AddsAMillionTimesToOnePhotonExactly) {
  test::StabilityCase listed(32, "1e6 redistributions into one photon", "exact");
  const Scene scene = beam();
  RenderJob many = job(1'100'000, 1e-3);
  many.maxDepth = 1;
  test::MapRig rig(context(), scene, many);
  rig.parameters.quotaPhotons = 1;
  for (const uint receivers : {0u, 1u}) {
    const PhotonMapCounts counts = rig.counts(rig.shoot(MapKind::global, DensityControl::density, receivers));
    EXPECT_EQ(counts.stored, 1u);
    EXPECT_GT(counts.redistributed, 1'000'000u);
    EXPECT_TRUE(counts.isEnergyExact);
    EXPECT_NEAR(counts.fluxMap[0] / counts.fluxMap[2], 3, 1e-4);
  }
  listed.note("equal", 1);
}

TEST_F(Redistribution, GivesTheSameMapInAnyBatches) {
  const Scene scene = room();
  std::array<double, 3> flux{};
  for (const std::uint32_t batch : {1u << 12, 1u << 15}) {
    RenderJob batched = job(1u << 15, 100);
    batched.photonBatch = batch;
    test::MapRig rig(context(), scene, batched);
    const PhotonMapCounts counts = rig.counts(rig.shoot(MapKind::global, DensityControl::density, 1));
    if (batch != 1u << 12) {
      EXPECT_EQ(counts.fluxMap, flux);
    }
    flux = counts.fluxMap;
  }
}

}  // namespace
}  // namespace importon::redistribution_test
