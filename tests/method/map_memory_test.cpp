// Photon maps take the memory of what they hold, and count all of it.
#include <gtest/gtest.h>

#include <array>

#include "method/map_rig.h"
#include "method/render_scene.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"

namespace importon::map_memory_test {
namespace {

constexpr double kDensity = 500;  // photons/m², of a room that gets some 20 times as many

/// A closed bright room: photons leave many hits.
Scene room() {
  test::SceneBuilder builder;
  const uint white = builder.material(test::diffuse(vec3(0.9f)));
  builder.box(white, {-1, -1, -1}, {1, 1, 1}, test::Facing::inside);
  builder.square(builder.material(test::emitter(vec3(5))), {0, 0.99, 0}, {0, -1, 0}, 0.5);
  builder.camera({0, 0, 0.9}, {0, 0, 0}, 1.0, 24, 24);
  return builder.finish();
}

RenderJob roomJob(std::uint32_t photons) {
  RenderJob job;
  job.passes = 1;
  job.photons = photons;
  job.photonBatch = 1u << 12;
  job.importons = 1u << 12;
  job.constantDensity = kDensity;
  job.gatherFrom = GatherSource::photons;
  return job;
}

/// How maps may be filled and read.
struct Case {
  const char* name;
  DensityControl control;
  uint receivers = 0;
  MapLookup lookup = MapLookup::radius;
  IrradianceCache irradiance = IrradianceCache::off;
};

class PhotonMapMemory : public test::GpuTest, public testing::WithParamInterface<Case> {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    job_.lookup = GetParam().lookup;
    job_.control = GetParam().control;
    rig_.emplace(context(), scene_, job_);
    rig_->findImportance();
    if (GetParam().control == DensityControl::probability) expected_ = rig_->countPilot(MapKind::global);
  }
  void TearDown() override {
    expected_.reset();
    rig_.reset();
    GpuTest::TearDown();
  }

  void fill(PhotonMap& map) {
    rig_->shootInto(map, MapKind::global,
                    {GetParam().control, GetParam().receivers, expected_ ? &*expected_ : nullptr});
    if (GetParam().irradiance != IrradianceCache::off)
      rig_->estimateIrradiance(map, MapKind::global, GetParam().irradiance == IrradianceCache::photons);
  }
  [[nodiscard]] PhotonMap makeMap() { return {context(), MapKind::global, rig_->plan.mapCapacity}; }
  [[nodiscard]] test::MapRig& rig() { return *rig_; }

 private:
  Scene scene_ = room();
  RenderJob job_ = roomJob(1u << 15);
  std::optional<test::MapRig> rig_;
  std::optional<ExpectedDensity> expected_;
};

INSTANTIATE_TEST_SUITE_P(Of, PhotonMapMemory,
                         testing::Values(Case{"AllHits", DensityControl::off}, Case{"Cells", DensityControl::density},
                                         Case{"Quota", DensityControl::density, 4},
                                         Case{"Probability", DensityControl::probability},
                                         Case{"NearestLookups", DensityControl::density, 0, MapLookup::nearest},
                                         Case{"IrradianceAtPhotons", DensityControl::density, 0, MapLookup::radius,
                                              IrradianceCache::photons},
                                         Case{"IrradianceAtImportons", DensityControl::density, 0, MapLookup::radius,
                                              IrradianceCache::importons}),
                         [](const auto& of) { return of.param.name; });

TEST_P(PhotonMapMemory, CountsEveryBuffer) {
  {
    PhotonMap first = makeMap();
    fill(first);  // makes the room that all maps share
  }
  const std::uint64_t before = context().allocatedBytes();
  PhotonMap map = makeMap();
  EXPECT_EQ(map.bytes(), context().allocatedBytes() - before) << "empty";
  fill(map);
  EXPECT_EQ(map.bytes(), context().allocatedBytes() - before);
}

// The first filling makes room again and again, the second one has it.
TEST_P(PhotonMapMemory, HoldsTheSamePhotonsWhetherItGrowsOrNot) {
  PhotonMap map = makeMap();
  fill(map);
  const std::vector<MapPoint> photons = rig().photons(map);
  const std::vector<vec3> flux = rig().flux(map);
  const std::uint64_t bytes = map.bytes();
  EXPECT_TRUE(rig().counts(map).isEnergyExact);
  EXPECT_GT(photons.size(), 1000u);
  fill(map);
  EXPECT_EQ(map.bytes(), bytes);
  const std::vector<MapPoint> again = rig().photons(map);
  ASSERT_EQ(again.size(), photons.size());
  for (std::size_t i = 0; i < photons.size(); ++i) {
    ASSERT_EQ(again[i].position, photons[i].position) << "photon " << i;
    ASSERT_EQ(again[i].packed, photons[i].packed) << "photon " << i;
  }
  EXPECT_EQ(rig().flux(map), flux);
}

class MapMemory : public test::GpuTest {
 protected:
  /// Bytes and photons of the global map of a room.
  struct Held {
    double bytes, photons;
  };
  Held held(std::uint32_t photons, DensityControl control) {
    test::MapRig rig(context(), scene_, roomJob(photons));
    const PhotonMap map = rig.shoot(MapKind::global, control, 0);
    return {static_cast<double>(map.bytes()), static_cast<double>(rig.counts(map).stored)};
  }
  const Scene scene_ = room();
};

TEST_F(MapMemory, GrowsWithWhatIsStored) {
  const Held few = held(1u << 13, DensityControl::off), many = held(1u << 16, DensityControl::off);
  EXPECT_NEAR(many.photons / few.photons, 8, 0.5);
  EXPECT_GT(many.bytes, 5 * few.bytes);
  EXPECT_LT(many.bytes, 11 * few.bytes);
  // 68 bytes of points, flux and what lookups read, at most 16 of its grid, and a quarter to grow.
  EXPECT_LT(many.bytes / many.photons, 1.25 * (68 + 16));
}

TEST_F(MapMemory, WithControlIsATenthOfThatWithout) {
  const Held all = held(1u << 16, DensityControl::off), controlled = held(1u << 16, DensityControl::density);
  EXPECT_LT(controlled.photons, all.photons / 20);
  EXPECT_LT(controlled.bytes, all.bytes / 10);
}

TEST_F(MapMemory, IsInTheStatisticsAndInThePeakOfTheDevice) {
  RenderJob job = roomJob(1u << 17);
  const RenderStats controlled = test::renderScene(scene_, job).stats;
  job.control = DensityControl::off;
  const RenderStats all = test::renderScene(scene_, job).stats;
  EXPECT_GT(controlled.photonMapBytes, 0u);
  EXPECT_GT(all.photonMapBytes, 10 * controlled.photonMapBytes);
  EXPECT_GT(all.devicePeakBytes, controlled.devicePeakBytes + (all.photonMapBytes - controlled.photonMapBytes) / 2);
}

// Records are made room for at every event; where that failed, hits would be lost.
TEST_F(MapMemory, OfABatchHoldsAllHitsWhateverItsSize) {
  std::uint64_t first = 0;
  for (const std::uint32_t batch : {1u << 9, 1u << 11, 1u << 14}) {
    RenderJob job = roomJob(1u << 14);
    job.photonBatch = batch;
    test::MapRig rig(context(), scene_, job);
    const PhotonMapCounts counts = rig.counts(rig.shoot(MapKind::global, DensityControl::off, 0));
    if (first == 0) first = counts.hits;
    EXPECT_EQ(counts.hits, first) << "batches of " << batch;
    EXPECT_EQ(counts.stored, counts.hits) << "batches of " << batch;
    EXPECT_GT(counts.hits, 5u << 14) << "many to a photon";
  }
}

}  // namespace
}  // namespace importon::map_memory_test
