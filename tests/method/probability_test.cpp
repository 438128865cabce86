// Storage by probability: as many photons as required, all power in the mean, and no weight above 1/ε.
#include <gtest/gtest.h>

#include <cmath>

#include "method/map_rig.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"
#include "support/statistics.h"

namespace importon {
namespace {

using test::SceneBuilder;

constexpr double kSignificance = 1e-3;  // of each test here, two-sided

/// A plane of 2 x 2 m in light from straight above, which each photon hits once.
Scene plane() {
  SceneBuilder builder;
  builder.square(builder.material(test::diffuse(vec3(0.5f))), {0, 0, 0}, {0, 1, 0}, 2);
  builder.directionalLight({0, -1, 0}, vec3(1));
  builder.camera({0, 2, 0}, {0, 0, 0}, 0.5, 16, 16, {0, 0, -1});
  return builder.finish();
}

RenderJob planeJob(double density) {
  RenderJob job;
  job.passes = 1;
  job.photons = 1u << 16;
  job.importons = 1u << 10;
  job.maxDepth = 3;
  job.constantDensity = density;
  return job;
}

class ProbabilityControl : public test::GpuTest {
 protected:
  static PhotonMapCounts shoot(test::MapRig& rig, float floorProbability) {
    const ExpectedDensity expected = rig.countPilot(MapKind::global);
    return rig.counts(rig.shoot(MapKind::global, {DensityControl::probability, 0, &expected, floorProbability}));
  }
  PhotonMapCounts shootOnce(double density, float floorProbability) {
    const Scene scene = plane();
    test::MapRig rig(context(), scene, planeJob(density));
    return shoot(rig, floorProbability);
  }
};

TEST_F(ProbabilityControl, StoresTheRequiredDensity) {
  const double required = 1000, area = 4;
  const PhotonMapCounts counts = shootOnce(required, 0);
  // A cell's pilot count C has the mean m; the mean of 1/C is (1 + 1/m)/m to first order. Cells are up to 16 % smaller
  // than 8 required photons need, and on this plane all alike.
  const double perCell = 8 * static_cast<double>(counts.hits) / (required * area);
  const double expected = required * area * (1 + 1 / (0.92 * perCell));
  const test::TestResult result = test::zTest(static_cast<double>(counts.stored), std::sqrt(expected), expected);
  EXPECT_GT(result.pValue, kSignificance) << counts.stored << " for " << expected;
  EXPECT_EQ(counts.redistributed, 0u);
}

TEST_F(ProbabilityControl, KeepsThePowerInTheMeanAndTheMapHoldsWhatWasKept) {
  const Scene scene = plane();
  test::MapRig rig(context(), scene, planeJob(500));
  test::Moments ratios;
  for (uint seed = 0; seed < 12; ++seed) {
    rig.parameters.seed = seed;
    const PhotonMapCounts counts = shoot(rig, 0);
    EXPECT_TRUE(counts.isEnergyExact);
    EXPECT_LT(counts.stored, counts.hits / 4);
    ratios.add(counts.fluxMap[0] / counts.fluxHits[0]);
  }
  EXPECT_GT(ratios.standardError(), 0);
  EXPECT_GT(test::tTest(ratios, 1).pValue, kSignificance) << ratios.mean() << " +- " << ratios.standardError();
}

TEST_F(ProbabilityControl, StoresEverythingAtAFloorOfOne) {
  const PhotonMapCounts counts = shootOnce(100, 1);
  EXPECT_EQ(counts.stored, counts.hits);
  EXPECT_EQ(counts.fluxMap, counts.fluxHits);
}

TEST_F(ProbabilityControl, StoresAtLeastTheFloorsShare) {
  const PhotonMapCounts counts = shootOnce(1, 0.25f);  // next to nothing is required
  const double expected = 0.25 * static_cast<double>(counts.hits);
  const double spread = std::sqrt(expected * 0.75);
  EXPECT_GT(test::zTest(static_cast<double>(counts.stored), spread, expected).pValue, kSignificance) << counts.stored;
  EXPECT_NEAR(counts.fluxMap[0] / counts.fluxHits[0], static_cast<double>(counts.stored) / expected, 1e-3);
}

}  // namespace
}  // namespace importon
