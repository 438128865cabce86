#include <gtest/gtest.h>

#include "render/run_totals.h"

namespace importon::stats_sum_test {
namespace {

RenderStats device(std::uint32_t seed, double photonSeconds) {
  RenderStats stats;
  stats.deviceName = seed == 0 ? "first" : "other";
  stats.passes = 3;
  stats.seconds.photons = photonSeconds;
  stats.seconds.device = photonSeconds;
  stats.closestRays = 10;
  stats.importonsGlobal = 5;
  stats.photonsEmitted = 1000;
  stats.devicePeakBytes = 64;
  stats.triangles = 12;
  stats.global = {1000, 900, 800, 100, {1.0 + seed, 2, 3}, {1.0 + seed, 2, 3}};
  stats.kernels = {{"trace", 4, 2.0}, {seed == 0 ? "a" : "b", 1, 1.0}};
  stats.devices = {{stats.deviceName, "driver", "cpu", seed, 3, 1000, 64}};
  return stats;
}

TEST(StatsSum, OfOneDeviceIsItsOwn) {
  const RenderStats own = device(0, 3), sum = sumOf(std::vector{own});
  EXPECT_EQ(sum.seconds.photons, own.seconds.photons);
  EXPECT_EQ(sum.global.fluxMap, own.global.fluxMap);
  EXPECT_EQ(sum.kernels.size(), 2u);
}

/// Photons over seconds are those that all devices shoot in a second.
TEST(StatsSum, CountsAreSumsAndTimesAtOnceMeans) {
  const RenderStats sum = sumOf(std::vector{device(0, 2), device(1, 4)});
  EXPECT_EQ(sum.deviceName, "first");
  EXPECT_EQ(sum.passes, 6);
  EXPECT_EQ(sum.seconds.photons, 3);
  EXPECT_EQ(sum.seconds.device, 4);
  EXPECT_EQ(sum.closestRays, 20u);
  EXPECT_EQ(sum.importonsGlobal, 10u);
  EXPECT_EQ(sum.photonsEmitted, 2000u);
  EXPECT_EQ(sum.devicePeakBytes, 128u);
  EXPECT_EQ(sum.triangles, 12u);
  EXPECT_EQ(sum.global.stored, 1600u);
  EXPECT_EQ(sum.global.fluxHits, (std::array<double, 3>{1.5, 2, 3}));
  ASSERT_EQ(sum.kernels.size(), 3u);
  EXPECT_EQ(sum.kernels[0].launches, 8u);
  EXPECT_EQ(sum.kernels[0].milliseconds, 4);
  ASSERT_EQ(sum.devices.size(), 2u);
  EXPECT_EQ(sum.devices[1].seed, 1u);
}

}  // namespace
}  // namespace importon::stats_sum_test
