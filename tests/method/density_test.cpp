// Stored density follows required density, whatever the batches; and the controlled map holds all power.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "method/map_rig.h"
#include "method/render_scene.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"
#include "support/stability.h"

namespace importon::density_test {
namespace {

using glm::dvec3;
using test::SceneBuilder;

/// A plane of 2 x 2 m in light from straight above, which each photon hits once; the camera above it.
Scene plane(float albedo = 0.5f, double irradiance = 1) {
  SceneBuilder builder;
  builder.square(builder.material(test::diffuse(vec3(albedo))), {0, 0, 0}, {0, 1, 0}, 2);
  builder.directionalLight({0, -1, 0}, vec3(static_cast<float>(irradiance)));
  builder.camera({0, 2, 0}, {0, 0, 0}, 0.5, 32, 32, {0, 0, -1});
  return builder.finish();
}

RenderJob planeJob(double density, std::uint32_t photons = 1u << 18) {
  RenderJob job;
  job.passes = 1;
  job.photons = photons;
  job.importons = 1u << 14;
  job.maxDepth = 3;
  job.constantDensity = density;
  job.gatherFrom = GatherSource::photons;
  return job;
}

class DensityControlTest : public test::GpuTest {};

// Receivers: 0 for control by cells, else M' and the rank quota.
class DensityControlBy : public test::GpuTest, public testing::WithParamInterface<uint> {};
INSTANTIATE_TEST_SUITE_P(Receivers, DensityControlBy, testing::Values(0u, 1u));

TEST_P(DensityControlBy, StoresTheRequiredDensityEverywhere) {
  const uint receivers = GetParam();
  const double density = 4000;  // photons/m²; 40,000 arrive
  const Scene scene = plane();
  test::MapRig rig(context(), scene, planeJob(density));
  const PhotonMap map = rig.shoot(MapKind::global, DensityControl::density, receivers);
  constexpr int kSide = 8;  // cells across the inner 1.6 m: 160 photons each
  std::vector<int> cells(kSide * kSide);
  for (const MapPoint& photon : rig.photons(map)) {
    const int x = static_cast<int>(std::floor((photon.position.x + 0.8f) / 0.2f));
    const int z = static_cast<int>(std::floor((photon.position.z + 0.8f) / 0.2f));
    if (x >= 0 && x < kSide && z >= 0 && z < kSide) ++cells[static_cast<std::size_t>(x * kSide + z)];
  }
  for (const int count : cells) {
    EXPECT_GT(count / 0.04, 0.9 * density);
    EXPECT_LT(count / 0.04, 1.4 * density);
  }
}

TEST_F(DensityControlTest, ByCellsStoresTheSamePhotonsInBatchesOfAnySize) {
  test::StabilityCase listed(29, "batches of 2^10 to all photons", "the same photons");
  const Scene scene = plane();
  std::vector<MapPoint> first;
  const auto byPlace = [](const MapPoint& a, const MapPoint& b) {
    return std::tie(a.position.x, a.position.z, a.packed) < std::tie(b.position.x, b.position.z, b.packed);
  };
  for (const std::uint32_t batch : {1u << 10, 1u << 14, 1u << 18}) {
    RenderJob job = planeJob(4000);
    job.photonBatch = batch;
    test::MapRig rig(context(), scene, job);
    const PhotonMap map = rig.shoot(MapKind::global, DensityControl::density, 0);
    EXPECT_TRUE(rig.counts(map).isEnergyExact) << "batches of " << batch;
    std::vector<MapPoint> photons = rig.photons(map);
    std::sort(photons.begin(), photons.end(), byPlace);
    if (first.empty()) first = photons;
    ASSERT_EQ(photons.size(), first.size()) << "batches of " << batch;
    for (std::size_t i = 0; i < photons.size(); ++i) ASSERT_EQ(photons[i].position, first[i].position);
  }
  listed.note("equal", 1);
}

// One batch counts all hits before a hit, so it stores D_r; many small ones count stored photons only, and fill the
// gaps between them up to a third more.
TEST_F(DensityControlTest, ByQuotaStoresTheRequiredDensityInBatchesOfAnySize) {
  const Scene scene = plane();
  constexpr double kRequired = 4000 * 2 * 2;
  for (const std::uint32_t batch : {1u << 12, 1u << 15, 1u << 18}) {
    RenderJob job = planeJob(4000);
    job.photonBatch = batch;
    test::MapRig rig(context(), scene, job);
    const PhotonMapCounts counts = rig.counts(rig.shoot(MapKind::global, DensityControl::density, 1));
    EXPECT_GT(static_cast<double>(counts.stored) / kRequired, 0.9) << "batches of " << batch;
    EXPECT_LT(static_cast<double>(counts.stored) / kRequired, 1.4) << "batches of " << batch;
    EXPECT_TRUE(counts.isEnergyExact) << "batches of " << batch;
  }
}

/// Of `hits` up to `end` those nearer than `radius` to `position`.
uint countWithin(const std::vector<vec3>& hits, std::size_t end, const vec3& position, float radius) {
  return static_cast<uint>(
      std::count_if(hits.begin(), hits.begin() + static_cast<std::ptrdiff_t>(end),
                    [&](const vec3& hit) { return glm::dot(hit - position, hit - position) < radius * radius; }));
}

// Against a search through all hits of one batch, in their order. A hit without a receiver is stored after all, but a
// receiver takes from half the radius around it at least.
TEST_F(DensityControlTest, ByQuotaStoresHitsBeforeWhichFewerThanTheQuotaFellNearby) {
  constexpr float kRequired = 100;  // photons/m²; 650 arrive
  const Scene scene = plane();
  test::MapRig rig(context(), scene, planeJob(kRequired, 1u << 12));
  std::vector<vec3> hits;
  for (const MapPoint& hit : rig.photonsAsStored(rig.shoot(MapKind::global, DensityControl::off, 0)))
    hits.push_back(hit.position);
  for (const uint quota : {1u, 3u, 8u}) {
    rig.parameters.quotaPhotons = static_cast<float>(quota);
    const float radius = std::sqrt(rig.parameters.quotaPhotons / (static_cast<float>(M_PI) * kRequired));
    std::vector<vec3> accepted, others;
    for (std::size_t i = 0; i < hits.size(); ++i)
      (countWithin(hits, i, hits[i], radius) < quota ? accepted : others).push_back(hits[i]);
    ASSERT_LT(3 * accepted.size(), others.size());
    std::vector<vec3> stored;
    for (const MapPoint& photon : rig.photonsAsStored(rig.shoot(MapKind::global, DensityControl::density, 1)))
      stored.push_back(photon.position);
    ASSERT_GE(stored.size(), accepted.size()) << "quota " << quota;
    const auto rest = stored.begin() + static_cast<std::ptrdiff_t>(accepted.size());
    EXPECT_TRUE(std::equal(accepted.begin(), accepted.end(), stored.begin())) << "quota " << quota;
    EXPECT_TRUE(std::none_of(
        rest, stored.end(),
        [&](const vec3& position) { return countWithin(accepted, accepted.size(), position, 0.49f * radius) > 0; }))
        << "quota " << quota;
  }
}

/// What a batch stored for want of a receiver counts for the next one as well.
TEST_F(DensityControlTest, ByQuotaSeesAllThatFormerBatchesStored) {
  constexpr float kRequired = 100;  // photons/m²; 650 arrive in each of two batches
  const Scene scene = plane();
  RenderJob job = planeJob(kRequired, 1u << 13);
  job.photonBatch = 1u << 12;
  test::MapRig rig(context(), scene, job);
  rig.parameters.quotaPhotons = 1;
  const float radius = std::sqrt(1 / (static_cast<float>(M_PI) * kRequired));
  const auto shoot = [&](std::uint32_t photons) {
    rig.plan.whole.photons = photons;
    std::vector<vec3> stored;
    for (const MapPoint& photon : rig.photonsAsStored(rig.shoot(MapKind::global, DensityControl::density, 1)))
      stored.push_back(photon.position);
    return stored;
  };
  const std::vector<vec3> first = shoot(1u << 12), both = shoot(1u << 13);
  ASSERT_GT(both.size(), first.size());
  ASSERT_TRUE(std::equal(first.begin(), first.end(), both.begin()));
  for (std::size_t i = first.size(); i < both.size(); ++i)
    EXPECT_EQ(countWithin(first, first.size(), both[i], 0.49f * radius), 0u) << i;
}

// The ramp turns hits away below the required density too, the program's limits none among the first few.
TEST_F(DensityControlTest, ByCosineStoresLessThanByStep) {
  const Scene scene = plane();
  RenderJob job = planeJob(4000);
  job.photonBatch = 1u << 15;
  test::MapRig rig(context(), scene, job);
  const auto stored = [&](uint acceptance, uint fewest) {
    const StorageRule rule{DensityControl::density, 1, nullptr, 0, acceptance, kShareEqual, fewest};
    return static_cast<double>(rig.counts(rig.shoot(MapKind::global, rule)).stored);
  };
  const double step = stored(kAcceptStep, 0), cosine = stored(kAcceptCosine, 0);
  EXPECT_LT(cosine, 0.95 * step);
  EXPECT_GT(cosine, 0.5 * step);
  EXPECT_GT(stored(kAcceptCosine, 3), cosine);
}

// So many neighbours count as none, but not more, however few the quota asks for.
TEST_F(DensityControlTest, OfTheProgramsLimitsTurnsHitsAwayAfterThoseThatCountAsNone) {
  const Scene scene = plane();
  test::MapRig rig(context(), scene, planeJob(100));
  rig.parameters.largestQuotaRadius = 0.5f * std::sqrt(1.0f / (100 * static_cast<float>(M_PI)));  // of a quarter photon
  const StorageRule rule{DensityControl::density, 20, nullptr, 0, kAcceptStep, kShareEqual, 3};
  const PhotonMapCounts counts = rig.counts(rig.shoot(MapKind::global, rule));
  EXPECT_GT(counts.stored, 0u);
  EXPECT_LT(counts.stored, counts.hits / 4);
}

TEST_F(DensityControlTest, FollowsImportance) {
  const Scene scene = plane();
  RenderJob job = planeJob(0);
  job.constantDensity.reset();
  job.globalDensity = 1.5;
  job.forcesAllFeatures = true;
  job.causticDensity = 2;
  test::MapRig rig(context(), scene, job);
  rig.findImportance();
  // Seen straight from above: 6 photons a pixel, and 1024 pixels see (2·2·tan 0.25)² m²: more than the floor.
  rig.parameters.globalMap.photonsPerPixel = 6;
  rig.seeGlobalMapDirectly();
  const PhotonMap map = rig.shoot(MapKind::global, DensityControl::density, 1);
  const double half = 0.8 * 2 * std::tan(0.25);
  int seen = 0;
  for (const MapPoint& p : rig.photons(map)) seen += std::max(std::abs(p.position.x), std::abs(p.position.z)) < half;
  const double expected = 6 * 1024 * 0.8 * 0.8;
  EXPECT_GT(seen, 0.9 * expected);
  EXPECT_LT(seen, 1.4 * expected);
}

TEST_F(DensityControlTest, StoresNoMoreThanItsCapacity) {
  const Scene scene = plane();
  test::MapRig rig(context(), scene, planeJob(1e9));
  const PhotonMapCounts counts = rig.counts(rig.shoot(MapKind::global, DensityControl::density, 1, 5000));
  EXPECT_EQ(counts.stored, 5000u);
  EXPECT_EQ(counts.overflow, counts.hits - 5000 - counts.redistributed);
  const PhotonMapCounts byCells = rig.counts(rig.shoot(MapKind::global, DensityControl::density, 0, 5000));
  EXPECT_EQ(byCells.stored, 5000u);
  EXPECT_GT(byCells.overflow, 0u);
}

/// A lit box: its walls see one another, so the global map is read.
Scene litRoom() {
  SceneBuilder builder;
  const uint white = builder.material(test::diffuse(vec3(0.7f)));
  builder.box(white, {-1, -1, -1}, {1, 1, 1}, test::Facing::inside);
  builder.square(builder.material(test::emitter(vec3(5))), {0, 0.99, 0}, {0, -1, 0}, 0.5);
  builder.camera({0, 0, 0.9}, {0, 0, 0}, 1.0, 24, 24);
  return builder.finish();
}

TEST_F(DensityControlTest, KeepsAllPowerWhereMemoryIsShort) {
  const Scene room = litRoom();
  for (const DensityControl control : {DensityControl::density, DensityControl::off}) {
    RenderJob job = planeJob(1e9, 1u << 14);
    job.control = control;
    job.memoryMiB = 1;
    const RenderResult result = test::renderScene(room, job);
    EXPECT_GT(result.stats.global.hits, 20'000u);
    EXPECT_LT(result.stats.global.stored, 6'000u);
    EXPECT_GT(result.stats.global.stored, 500u);
    EXPECT_EQ(result.stats.global.fluxHits, result.stats.global.fluxMap);
  }
}

TEST_F(DensityControlTest, OfAnImmenseDensityGivesTheUncontrolledImageBitForBit) {
  test::StabilityCase listed(27, "required density without bound", "the uncontrolled image");
  const Scene room = litRoom();
  RenderJob job = planeJob(0, 1u << 13);
  job.passes = 4;
  job.constantDensity.reset();
  job.globalDensity = 1e9;
  const RenderResult controlled = test::renderScene(room, job);
  job.control = DensityControl::off;
  const RenderResult uncontrolled = test::renderScene(room, job);
  ASSERT_EQ(controlled.stats.global.redistributed, 0u);
  EXPECT_GT(test::meanOf(uncontrolled), 0);
  for (const char* name : {"R", "G", "B"})
    EXPECT_EQ(test::channel(controlled, name), test::channel(uncontrolled, name));
  listed.note("the same bits", 1);
}

TEST_F(DensityControlTest, OfAVanishingDensityKeepsAllPowerAndStaysFinite) {
  test::StabilityCase listed(28, "required density 0", "power kept, finite");
  const Scene scene = litRoom();
  RenderJob job = planeJob(1e-30, 1u << 14);
  const RenderResult result = test::renderScene(scene, job);
  EXPECT_EQ(result.stats.global.fluxHits, result.stats.global.fluxMap);
  EXPECT_GT(result.stats.global.redistributed, result.stats.global.stored * 100);
  for (const char* name : {"R", "G", "B"})
    for (const float v : test::channel(result, name)) ASSERT_TRUE(std::isfinite(v) && v >= 0);
  listed.note("equal", 1);
}

}  // namespace
}  // namespace importon::density_test
