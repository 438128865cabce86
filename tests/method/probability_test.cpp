// Storage by probability: as many photons as required, all power in the mean, and no weight above 1/ε.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "method/map_rig.h"
#include "support/claims.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"
#include "support/statistics.h"

namespace importon::probability_test {
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

/// The plane in the light of a lamp above a corner, so that the probability differs from place to place. All photons
/// but those at the light's very edge have the same flux.
Scene unevenlyLitPlane() {
  SceneBuilder builder;
  builder.square(builder.material(test::diffuse(vec3(0.5f))), {0, 0, 0}, {0, 1, 0}, 2);
  builder.spotLight({0.6, 0.8, 0.6}, glm::normalize(glm::dvec3(-0.6, -0.8, -0.6)), vec3(1), 0.999, 1);
  builder.camera({0, 2, 0}, {0, 0, 0}, 0.5, 16, 16, {0, 0, -1});
  return builder.finish();
}

constexpr int kPlaces = 6;  // squares along each side of the plane

std::size_t placeOf(const vec3& p) {
  const auto at = [](float x) { return std::clamp(static_cast<int>((x + 1) / 2 * kPlaces), 0, kPlaces - 1); };
  return static_cast<std::size_t>(at(p.x) * kPlaces + at(p.z));
}

/// Each hit is kept with its p and weighs 1/p, so what is kept at a place is in the mean what all hits bring there:
/// those of the same photons without control. Its variance is estimated without bias by the kept ones' (1-p)/p²
/// [Horvitz and Thompson 1952], in units of a photon's flux.
TEST_F(ProbabilityControl, KeepsThePowerOfEveryPlaceInExpectation) {
  constexpr int kSeeds = 32;
  const Scene scene = unevenlyLitPlane();
  RenderJob job = planeJob(4000);
  job.photons = 1u << 17;
  test::MapRig rig(context(), scene, job);
  rig.parameters.maxDepth = 0;
  test::Moments ratios;  // of all power kept to all power
  double squares = 0, places = 0, leastWeight = 1e30, greatestWeight = 0;
  for (uint seed = 0; seed < kSeeds; ++seed) {
    rig.parameters.seed = seed;
    const ExpectedDensity expected = rig.countPilot(MapKind::global);
    const StorageRule rule{DensityControl::probability, 0, &expected, 0};
    const PhotonMap all = rig.shoot(MapKind::global, DensityControl::off, 0);
    const std::vector<MapPoint> photonsOfAll = rig.photons(all);
    const std::vector<vec3> fluxOfAll = rig.flux(all);
    const PhotonMap kept = rig.shoot(MapKind::global, rule);
    EXPECT_TRUE(rig.counts(kept).isEnergyExact);
    double unit = 0;  // a photon's flux
    for (const vec3& f : fluxOfAll) unit = std::max(unit, static_cast<double>(f.x));
    std::vector<double> hits(kPlaces * kPlaces), sums(hits.size()), variances(hits.size());
    const std::vector<MapPoint> photons = rig.photons(kept);
    for (std::size_t i = 0; i < photonsOfAll.size(); ++i)
      hits[placeOf(photonsOfAll[i].position)] += static_cast<double>(fluxOfAll[i].x) / unit;
    const std::vector<vec3> flux = rig.flux(kept);
    for (std::size_t i = 0; i < photons.size(); ++i) {
      const double weight = static_cast<double>(flux[i].x) / unit;  // 1/p
      leastWeight = std::min(leastWeight, weight);
      greatestWeight = std::max(greatestWeight, weight);
      sums[placeOf(photons[i].position)] += weight;
      variances[placeOf(photons[i].position)] += weight * std::max(weight - 1, 0.0);
    }
    for (std::size_t place = 0; place < hits.size(); ++place) {
      if (variances[place] < 100) continue;  // too few for a normal distribution
      squares += (sums[place] - hits[place]) * (sums[place] - hits[place]) / variances[place];
      ++places;
    }
    ratios.add(std::accumulate(sums.begin(), sums.end(), 0.0) / std::accumulate(hits.begin(), hits.end(), 0.0));
  }
  EXPECT_GT(greatestWeight, 3 * std::max(leastWeight, 1.0)) << "probabilities are all alike";
  // The deviations of all places and seeds are independent.
  EXPECT_GT(places, 10 * kSeeds);
  const double beyond = test::chiSquareBeyond(squares, places);
  EXPECT_GT(std::min(beyond, 1 - beyond), 0.5 * kSignificance) << squares << " of " << places;
  EXPECT_TRUE(test::isWithin(0.01, ratios, 1));
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
}  // namespace importon::probability_test
