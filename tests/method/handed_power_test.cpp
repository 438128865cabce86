// Where the power of hits goes that are not stored: to photons of their own cell, or of their own wall; and how
// many photons are stored where cells or the floor of the density alone decide it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "method/map_rig.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"

namespace importon::handed_power_test {
namespace {

using test::SceneBuilder;

RenderJob job(std::uint32_t photons, int maxDepth) {
  RenderJob made;
  made.passes = 1;
  made.photons = photons;
  made.importons = 1u << 10;
  made.maxDepth = maxDepth;
  made.gatherFrom = GatherSource::photons;
  return made;
}

/// Photons that hold light of both colours, red and blue.
int countMixed(const std::vector<vec3>& flux) {
  return static_cast<int>(std::count_if(flux.begin(), flux.end(), [](const vec3& f) { return f.x > 0 && f.z > 0; }));
}

class HandedPower : public test::GpuTest {};

TEST_F(HandedPower, StaysInItsCell) {
  SceneBuilder builder;  // two spots apart, one red and one blue, whose photons come mixed
  builder.square(builder.material(test::diffuse(vec3(0.5f))), {0, 0, 0}, {0, 1, 0}, 2);
  builder.spotLight({-0.6, 1, 0}, {0, -1, 0}, vec3(1, 0, 0), 0.2, 0.21);
  builder.spotLight({0.6, 1, 0}, {0, -1, 0}, vec3(0, 0, 1), 0.2, 0.21);
  builder.camera({0, 1, 0}, {0, 0, 0}, 0.5, 16, 16, {0, 0, -1});
  const Scene scene = builder.finish();
  RenderJob spots = job(1u << 15, 1);
  spots.constantDensity = 500;
  test::MapRig rig(context(), scene, spots);
  const PhotonMap map = rig.shoot(MapKind::global, DensityControl::density, 0);
  EXPECT_GT(rig.counts(map).stored, 50u);
  EXPECT_GT(rig.counts(map).redistributed, 10 * rig.counts(map).stored);
  EXPECT_EQ(countMixed(rig.flux(map)), 0);
}

TEST_F(HandedPower, DoesNotGoRoundACorner) {
  SceneBuilder builder;  // a floor in red light and a wall in blue light, each parallel to the other's
  const uint white = builder.material(test::diffuse(vec3(0.5f)));
  builder.square(white, {0, 0, 0}, {0, 1, 0}, 2);
  builder.square(white, {-1, 1, 0}, {1, 0, 0}, 2);
  builder.directionalLight({0, -1, 0}, vec3(1, 0, 0));
  builder.directionalLight({-1, 0, 0}, vec3(0, 0, 1));
  builder.camera({1, 1, 0}, {-1, 0, 0}, 0.5, 16, 16);
  const Scene scene = builder.finish();
  RenderJob corner = job(1u << 15, 0);  // no light from one to the other
  corner.constantDensity = 200;
  test::MapRig rig(context(), scene, corner);
  const PhotonMap map = rig.shoot(MapKind::global, DensityControl::density, 8);
  EXPECT_GT(rig.counts(map).stored, 500u);
  EXPECT_GT(rig.counts(map).redistributed, 4 * rig.counts(map).stored);
  EXPECT_EQ(countMixed(rig.flux(map)), 0);
}

// A photon of the bright lamp comes to every wall many times; its hits are of different ranks.
TEST_F(HandedPower, IsOnePhotonsForEachWallWhereACellIsAsLargeAsTheScene) {
  SceneBuilder builder;
  builder.box(builder.material(test::diffuse(vec3(0.95f))), {-1, -1, -1}, {1, 1, 1}, test::Facing::inside);
  builder.pointLight({0.1, 0.2, 0.3}, vec3(1));
  builder.camera({0, 0, 0.9}, {0, 0, 0}, 1.0, 16, 16);
  const Scene scene = builder.finish();
  RenderJob room = job(1u << 12, 30);
  room.constantDensity = 1e-6;
  test::MapRig rig(context(), scene, room);
  const PhotonMapCounts counts = rig.counts(rig.shoot(MapKind::global, DensityControl::density, 0));
  EXPECT_EQ(counts.stored, 6u);
  EXPECT_GT(counts.hits, 10u << 12);
  EXPECT_TRUE(counts.isEnergyExact);
}

// No importon was found, so only the floor of the density asks for photons.
TEST_F(HandedPower, LeavesAtLeastTheFloorOfTheDensityWhereNoImportonIs) {
  SceneBuilder builder;
  builder.square(builder.material(test::diffuse(vec3(0.5f))), {0, 0, 0}, {0, 1, 0}, 2);
  builder.directionalLight({0, -1, 0}, vec3(1));
  builder.camera({0, 2, 0}, {0, 0, 0}, 0.5, 16, 16, {0, 0, -1});
  const Scene scene = builder.finish();
  test::MapRig rig(context(), scene, job(1u << 16, 1));
  rig.parameters.globalMap.densityFloor = 1000;
  const double stored = static_cast<double>(rig.counts(rig.shoot(MapKind::global, DensityControl::density, 0)).stored);
  EXPECT_GT(stored / (2 * 2), 0.8 * 1000);
  EXPECT_LT(stored / (2 * 2), 1.2 * 1000);
}

}  // namespace
}  // namespace importon::handed_power_test
