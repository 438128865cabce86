// A hundred million hand-overs to one photon.
#include <gtest/gtest.h>

#include "method/map_rig.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"
#include "support/stability.h"

namespace importon {
namespace {

class RedistributionSlow : public test::GpuTest {};

TEST_F(RedistributionSlow, AddsAHundredMillionTimesToOnePhotonExactly) {
  test::StabilityCase listed(32, "1e8 redistributions into one photon", "exact");
  test::SceneBuilder builder;  // a beam onto a spot of 1 cm, much smaller than the largest quota radius
  builder.square(builder.material(test::diffuse(vec3(0.5f))), {0, 0, 0}, {0, 1, 0}, 2);
  builder.spotLight({0, 1, 0}, {0, -1, 0}, vec3(3, 2, 1), 0.009, 0.01);
  builder.camera({0, 1, 0}, {0, 0, 0}, 0.5, 16, 16, {0, 0, -1});
  const Scene scene = builder.finish();
  RenderJob job;
  job.passes = 1;
  job.photons = 101'000'000;
  job.importons = 1u << 12;
  job.maxDepth = 1;
  job.constantDensity = 1e-3;
  test::MapRig rig(context(), scene, job);
  const PhotonMapCounts counts = rig.counts(rig.shoot(MapKind::global, DensityControl::density, 0));
  EXPECT_EQ(counts.stored, 1u);
  EXPECT_GT(counts.redistributed, 100'000'000u);
  EXPECT_TRUE(counts.isEnergyExact);
  EXPECT_NEAR(counts.fluxMap[0] / counts.fluxMap[2], 3, 1e-4);
  listed.note("equal", 1);
}

}  // namespace
}  // namespace importon
