// Lookups of the nearest photons, and pictures of photons, against a search through all of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "method/map_rig.h"
#include "render/camera/point_layer.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"

namespace importon::nearest_test {
namespace {

using test::SceneBuilder;

constexpr float kAlbedo = 0.5f;

/// A plane in even light with a bright spot: densities of 1 : 100.
Scene plane() {
  SceneBuilder builder;
  builder.square(builder.material(test::diffuse(vec3(kAlbedo))), {0, 0, 0}, {0, 1, 0}, 2);
  builder.directionalLight({0, -1, 0}, vec3(0.1f));
  builder.spotLight({0.1, 1, 0}, {0, -1, 0}, vec3(30), 0.099, 0.1);
  builder.camera({0, 2, 0}, {0, 0, 0}, 0.5, 24, 24, {0, 0, -1});
  return builder.finish();
}

/// Short paths, whose photons are read by the nearest `nearest`.
RenderJob nearestJob(std::uint32_t photons, int nearest) {
  RenderJob job;
  job.passes = 1;
  job.photons = photons;
  job.importons = 1u << 10;
  job.maxDepth = 1;
  job.lookup = MapLookup::nearest;
  job.lookupPhotons = nearest;
  return job;
}

class NearestPhotons : public test::GpuTest {};

/// The talk's estimate by brute force: flux of the M-1 nearest over the disc of the M-th.
double radianceAt(vec3 position, const std::vector<MapPoint>& photons, const std::vector<vec3>& flux,
                  std::size_t nearest) {
  std::vector<std::pair<float, float>> byDistance;
  for (std::size_t i = 0; i < photons.size(); ++i) {
    const vec3 offset = photons[i].position - position;
    byDistance.emplace_back(glm::dot(offset, offset), flux[i].x);
  }
  const auto last = byDistance.begin() + static_cast<std::ptrdiff_t>(nearest);
  std::partial_sort(byDistance.begin(), last, byDistance.end());
  double sum = 0;
  for (std::size_t i = 0; i + 1 < nearest; ++i) sum += byDistance[i].second;
  return sum * kAlbedo / M_PI / (M_PI * byDistance[nearest - 1].first);
}

TEST_F(NearestPhotons, AreThoseOfASearchThroughAll) {
  const Scene scene = plane();
  test::MapRig rig(context(), scene, nearestJob(1u << 14, 30));
  const PhotonMap map = rig.shoot(MapKind::global, DensityControl::off, 0);
  const std::vector<float> aovs = rig.aovs(map);
  const std::vector<MapPoint> photons = rig.photons(map);
  const std::vector<vec3> flux = rig.flux(map);
  int compared = 0;
  for (std::size_t at = 0; at < aovs.size(); at += 7 * kAovFloats) {
    const vec3 position(aovs[at + kAovPosition], aovs[at + kAovPosition + 1], aovs[at + kAovPosition + 2]);
    const double expected = radianceAt(position, photons, flux, 30);
    EXPECT_NEAR(aovs[at + kAovMapLight + 3] / expected, 1, 1e-3) << "at " << position.x << ", " << position.z;
    ++compared;
  }
  EXPECT_GT(compared, 80);
}

/// So few are required that lookups of a map of their density would reach across the plane.
TEST_F(NearestPhotons, AreFoundWhereTheMapIsFarDenserThanRequired) {
  const Scene scene = plane();
  RenderJob job = nearestJob(1u << 18, 80);
  job.constantDensity = 0.01;
  test::MapRig rig(context(), scene, job);
  const PhotonMap map = rig.shoot(MapKind::global, DensityControl::off, 0);
  const std::vector<float> aovs = rig.aovs(map);
  const std::vector<MapPoint> photons = rig.photons(map);
  const std::vector<vec3> flux = rig.flux(map);
  EXPECT_GT(photons.size(), 150'000u);
  int compared = 0, atEdge = 0;  // the spot's: beside so many photons not all M are looked for
  for (std::size_t at = 0; at < aovs.size(); at += 23 * kAovFloats, ++compared) {
    const vec3 position(aovs[at + kAovPosition], aovs[at + kAovPosition + 1], aovs[at + kAovPosition + 2]);
    const double expected = radianceAt(position, photons, flux, 80);
    const double error = std::abs(aovs[at + kAovMapLight + 3] / expected - 1);
    EXPECT_LT(error, 0.2) << "at " << position.x << ", " << position.z;
    atEdge += error > 1e-3 ? 1 : 0;
  }
  EXPECT_GT(compared, 20);
  EXPECT_LE(atEdge, 2);
}

/// A lamp that all but touches the plane: no grid tells its photons apart.
Scene lampOnPlane() {
  SceneBuilder builder;
  builder.square(builder.material(test::diffuse(vec3(kAlbedo))), {0, 0, 0}, {0, 1, 0}, 2);
  builder.directionalLight({0, -1, 0}, vec3(0.1f));
  builder.pointLight({0.1, 1e-7, 0}, vec3(0.1f));
  builder.camera({0, 2, 0}, {0, 0, 0}, 0.5, 24, 24, {0, 0, -1});
  return builder.finish();
}

TEST_F(NearestPhotons, OfManyInOnePlaceAreTheSameEveryTime) {
  const Scene scene = lampOnPlane();
  const auto light = [&] {
    test::MapRig rig(context(), scene, nearestJob(1u << 17, 80));
    const PhotonMap map = rig.shoot(MapKind::global, DensityControl::off, 0);
    const std::vector<MapPoint> photons = rig.photons(map);
    const auto near = std::count_if(photons.begin(), photons.end(), [](const MapPoint& p) {
      return glm::distance(p.position, vec3(0.1f, 0, 0)) < 1e-5f;
    });
    EXPECT_GT(near, 20'000);
    return rig.aovs(map);
  };
  const std::vector<float> first = light(), second = light();
  EXPECT_EQ(std::memcmp(first.data(), second.data(), first.size() * sizeof(float)), 0);
  for (std::size_t at = 0; at < first.size(); at += kAovFloats) EXPECT_GT(first[at + kAovMapLight + 3], 0);
}

/// A dim floor above a wall on which a spot light leaves some hundred times as many photons.
Scene dimFloor() {
  SceneBuilder builder;
  builder.square(builder.material(test::diffuse(vec3(kAlbedo))), {0, 0, 0}, {0, 1, 0}, 2);
  builder.square(builder.material(test::diffuse(vec3(0.01f))), {-0.1, -0.51, 0}, {1, 0, 0}, 1);
  builder.directionalLight({0, -1, 0}, vec3(0.01f));
  builder.spotLight({1, -0.51, 0}, {-1, 0, 0}, vec3(100), 0.4, 0.41);
  builder.camera({0, 2, 0}, {0, 0, 0}, 0.3, 16, 16, {0, 0, -1});
  return builder.finish();
}

TEST_F(NearestPhotons, AreFoundBesideASurfaceWithManyMore) {
  const Scene scene = dimFloor();
  test::MapRig rig(context(), scene, nearestJob(1u << 17, 80));
  const PhotonMap map = rig.shoot(MapKind::global, DensityControl::off, 0);
  EXPECT_GT(rig.photons(map).size(), 100'000u);
  const std::vector<float> aovs = rig.aovs(map);
  const double expected = 0.01 * kAlbedo / M_PI;
  double sum = 0, pixels = 0;
  for (std::size_t at = 0; at < aovs.size(); at += kAovFloats, ++pixels) {
    const double radiance = aovs[at + kAovMapLight + 3];
    EXPECT_GT(radiance, 0.2 * expected);
    sum += radiance / expected;
  }
  EXPECT_NEAR(sum / pixels, 1, 0.25);  // of some tens of photons, which neighbouring pixels share
}

TEST_F(NearestPhotons, OfAnEmptyMapAreNone) {
  const Scene scene = plane();
  RenderJob job;
  job.passes = 1;
  job.photons = 1;
  job.importons = 1u << 10;
  job.lookup = MapLookup::nearest;
  test::MapRig rig(context(), scene, job);
  for (const float value : rig.aovs(rig.shoot(MapKind::global, DensityControl::off, 0)))
    EXPECT_FALSE(std::isnan(value));
}

TEST_F(NearestPhotons, PicturesCountEveryPhotonInView) {
  const Scene scene = plane();
  RenderJob job;
  job.passes = 1;
  job.photons = 1u << 14;
  job.importons = 1u << 10;
  job.maxDepth = 1;
  test::MapRig rig(context(), scene, job);
  const PhotonMap map = rig.shoot(MapKind::global, DensityControl::off, 0);
  const std::vector<MapPoint> photons = rig.photons(map);
  const std::vector<float> counts = countPoints(photons, 2, rig.parameters, rig.aovs(map));
  const double half = 2 * std::tan(0.25);
  double inView = 0, counted = 0;
  for (const MapPoint& p : photons) inView += std::max(std::abs(p.position.x), std::abs(p.position.z)) < half ? 1 : 0;
  for (const float count : counts) counted += count;
  EXPECT_GT(inView, 1000);
  EXPECT_NEAR(counted, 2 * inView, 2);  // rounding at the edge
}

}  // namespace
}  // namespace importon::nearest_test
