#include "render/plan/device_shares.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <set>

namespace importon {
namespace {

using Passes = std::vector<int>;

TEST(DeviceShares, AreEvenAndTheFirstMakeOneMore) {
  EXPECT_EQ(sharePasses(8, Passes{0, 0}, false), (Passes{4, 4}));
  EXPECT_EQ(sharePasses(8, Passes{0, 0, 0}, false), (Passes{3, 3, 2}));
  EXPECT_EQ(sharePasses(1, Passes{0, 0}, false), (Passes{1, 0}));
  EXPECT_EQ(sharePasses(7, Passes{0}, false), (Passes{7}));
}

TEST(DeviceShares, StayTheSameWhileDevicesKeepStep) {
  for (int done = 0; done <= 3; ++done) EXPECT_EQ(sharePasses(7, Passes{done, done}, false), (Passes{4, 3}));
}

/// As after a device was lost, or where a run goes on that was to make fewer.
TEST(DeviceShares, LevelWhatIsUneven) {
  EXPECT_EQ(sharePasses(8, Passes{3, 2}, false), (Passes{4, 4}));
  EXPECT_EQ(sharePasses(9, Passes{5, 1, 0}, false), (Passes{5, 2, 2}));
  EXPECT_EQ(sharePasses(16, Passes{10, 2}, false), (Passes{10, 6}));
}

TEST(DeviceShares, OfARaceLeaveAFastDeviceAhead) {
  EXPECT_EQ(sharePasses(16, Passes{10, 2}, true), (Passes{12, 4}));
  EXPECT_EQ(sharePasses(13, Passes{8, 2}, true), (Passes{10, 3}));
}

/// All states of three devices and up to nine passes: never more in all than are wanted, never fewer than are done.
TEST(DeviceShares, ComeToWhatIsWanted) {
  for (int code = 0; code < 1000; ++code) {
    const Passes done{code % 10, code / 10 % 10, code / 100};
    const int sum = std::accumulate(done.begin(), done.end(), 0);
    for (int total = 0; total < 10; ++total)
      for (const bool isRace : {false, true}) {
        const Passes shares = sharePasses(total, done, isRace);
        EXPECT_EQ(std::accumulate(shares.begin(), shares.end(), 0), std::max(total, sum));
        for (std::size_t i = 0; i < done.size(); ++i) EXPECT_GE(shares[i], done[i]);
      }
  }
  constexpr int kMost = std::numeric_limits<int>::max();
  EXPECT_EQ(sharePasses(kMost, Passes{5, 0}, true), (Passes{5 + (kMost - 5) / 2, (kMost - 5) / 2}));
}

TEST(DeviceShares, SeedsOfNeighbouringJobsAreAllDifferent) {
  std::set<std::uint32_t> seeds;
  for (std::uint32_t seed = 0; seed < 1000; ++seed)
    for (std::size_t device = 0; device < 16; ++device) seeds.insert(seedOfDevice(seed, device));
  EXPECT_EQ(seeds.size(), 16'000u);
  EXPECT_EQ(seedOfDevice(7, 0), 7u);
}

}  // namespace
}  // namespace importon
