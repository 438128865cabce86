// Compaction, scan and sort (render/device/workspace.h) against the standard library.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "method/list_stage.h"

namespace importon {
namespace {

using Lists = test::ListTest;

const std::vector<std::size_t> kSizes{0, 1, 63, 64, 65, 4095, 4097, 100'000};

std::vector<uint> randomKeep(std::size_t count, double share, std::mt19937& random) {
  std::bernoulli_distribution stays(share);
  std::vector<uint> keep(count);
  for (uint& k : keep) k = stays(random);
  return keep;
}

std::vector<uint> indicesKept(const std::vector<uint>& keep) {
  std::vector<uint> kept;
  for (uint i = 0; i < keep.size(); ++i)
    if (keep[i] != 0) kept.push_back(i);
  return kept;
}

TEST_F(Lists, CompactionKeepsTheMarkedEntriesInTheirOrder) {
  std::mt19937 random(1);
  for (const std::size_t size : kSizes) {
    for (const double share : {0.0, 0.02, 0.5, 1.0}) {
      const std::vector<uint> keep = randomKeep(size, share, random);
      if (size > 0) work().keep.upload(std::span<const uint>(keep));
      setEntries(size);
      compact(stage(), kCounterEntries, kCounterTotal, nullptr, work().valuesA);
      stage().recorder.submitAndWait();
      const std::vector<uint> expected = indicesKept(keep);
      ASSERT_EQ(counter(kCounterTotal), expected.size()) << size << " entries, share " << share;
      EXPECT_EQ(test::numbers(work().valuesA, expected.size()), expected) << size << " entries, share " << share;
    }
  }
}

TEST_F(Lists, CountersAddUpBeyond32Bits) {
  setCounter(stage(), kCounterRecords, 0xFFFFFFF0u);
  for (int i = 0; i < 3; ++i) addCounter(stage(), kCounterRecords, kSumRaysClosest);
  setCounter(stage(), kCounterEntries, 1000);
  for (int i = 0; i < 2; ++i) addCounter(stage(), kCounterEntries, kSumRaysClosest, true);
  stage().recorder.submitAndWait();
  const auto counters = work().counters.download<uint>(kCounterCount);
  EXPECT_EQ(sumOf(counters, kSumRaysClosest), 3 * 0xFFFFFFF0ull + 1000);
  EXPECT_EQ(counter(kCounterRecords), 0xFFFFFFF0u);
  EXPECT_EQ(counter(kCounterEntries), 0u) << "emptied";
}

TEST_F(Lists, CompactionOfAQueueTakesItsValuesAndCountsWhatPassed) {
  std::mt19937 random(2);
  constexpr std::size_t kSize = 5000;
  const std::vector<uint> keep = randomKeep(kSize, 0.3, random);
  std::vector<uint> queue(kSize);
  std::generate(queue.begin(), queue.end(), std::ref(random));
  work().keep.upload(std::span<const uint>(keep));
  work().valuesA.upload(std::span<const uint>(queue));
  setEntries(kSize);
  setCounter(stage(), kCounterRecords, 17);
  compact(stage(), kCounterEntries, kCounterTotal, &work().valuesA, work().valuesB, kCounterRecords);
  stage().recorder.submitAndWait();
  std::vector<uint> expected;
  for (const uint i : indicesKept(keep)) expected.push_back(queue[i]);
  ASSERT_EQ(counter(kCounterTotal), expected.size());
  EXPECT_EQ(test::numbers(work().valuesB, expected.size()), expected);
  EXPECT_EQ(counter(kCounterRecords), 17 + kSize);
}

TEST_F(Lists, CountsLeadTheIndirectDispatchesOverWhatTheyCount) {
  for (const std::size_t size : kSizes) {
    setEntries(size);
    stage().recorder.submitAndWait();
    const auto arguments =
        work().dispatches.download<DispatchArguments>(1, kCounterEntries * sizeof(DispatchArguments)).front();
    const auto groups = [](std::size_t n) { return (n + kWorkgroupSize - 1) / kWorkgroupSize; };
    EXPECT_EQ(std::size_t{arguments.items.x} * arguments.items.y, groups(size));
    EXPECT_EQ(std::size_t{arguments.tiles.x} * arguments.tiles.y, groups((size + kTileSize - 1) / kTileSize));
    const std::size_t rayGroups = std::size_t{arguments.rays.x} * arguments.rays.y;
    EXPECT_GE(rayGroups, groups((size + 31) / 32));
    EXPECT_LE(rayGroups, groups(size));
  }
}

TEST_F(Lists, ScanIsTheExclusivePrefixSumAndTellsTheTotal) {
  std::mt19937 random(3);
  for (const std::size_t entries : kSizes) {
    for (const uint perTile : {1u, kRadix}) {
      std::vector<uint> sums((entries + kTileSize - 1) / kTileSize * perTile);
      std::generate(sums.begin(), sums.end(), [&] { return random() % 1000; });
      if (!sums.empty()) work().blockSums.upload(std::span<const uint>(sums));
      setEntries(entries);
      run<kernels::OneScan>(stage(), kScanThreads, {kCounterEntries, perTile, kCounterTotal, kNone});
      stage().recorder.submitAndWait();
      std::vector<uint> expected(sums.size());
      std::exclusive_scan(sums.begin(), sums.end(), expected.begin(), 0u);
      EXPECT_EQ(test::numbers(work().blockSums, sums.size()), expected) << entries << " entries";
      EXPECT_EQ(counter(kCounterTotal), std::accumulate(sums.begin(), sums.end(), 0u)) << entries << " entries";
    }
  }
}

class Sort : public test::ListTest {
 protected:
  /// Sorts `keys` on the device and compares with std::stable_sort by their `bits` low bits.
  void expectStablySorted(const std::vector<uint>& keys, uint bits) {
    if (!keys.empty()) work().keysA.upload(std::span<const uint>(keys));
    setEntries(keys.size());
    const gpu::Buffer order(context(), "order", std::max<std::size_t>(keys.size(), 1) * sizeof(uint));
    const gpu::Buffer& sorted = sortByKey(stage(), kCounterEntries, bits, order);
    stage().recorder.submitAndWait();
    std::vector<uint> expected(keys.size());
    std::iota(expected.begin(), expected.end(), 0u);
    std::stable_sort(expected.begin(), expected.end(), [&](uint a, uint b) { return keys[a] < keys[b]; });
    ASSERT_TRUE(test::numbers(order, keys.size()) == expected) << keys.size() << " keys of " << bits << " bits";
    const std::vector<uint> values = test::numbers(sorted, keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) ASSERT_EQ(values[i], keys[expected[i]]);
  }

  static std::vector<uint> randomKeys(std::size_t count, uint bits) {
    std::mt19937 random(static_cast<uint>(count) + bits);
    std::vector<uint> keys(count);
    std::generate(keys.begin(), keys.end(), [&] { return random() >> (32 - bits); });
    return keys;
  }
};

TEST_F(Sort, IsStableForRandomKeys) {
  for (uint bits = 12; bits <= 20; ++bits) expectStablySorted(randomKeys(20'011, bits), bits);
}

TEST_F(Sort, HoldsForAllSizes) {
  for (const std::size_t size : kSizes) expectStablySorted(randomKeys(size, 13), 13);
}

TEST_F(Sort, HoldsForAMillionKeys) { expectStablySorted(randomKeys(kMaxEntries, 20), 20); }

TEST_F(Sort, HoldsForMoreKeysThanLoopsOfTheScanMayTakeTurns) {
  constexpr std::size_t kKeys = 5'000'000;
  reserveEntries(stage(), kKeys);
  expectStablySorted(randomKeys(kKeys, 12), 12);
}

TEST_F(Sort, LeavesEqualKeysInTheirOrder) {
  for (const uint key : {0u, 0xFFFFFu}) expectStablySorted(std::vector<uint>(100'000, key), 20);
}

TEST_F(Sort, MayBeDoneAgainWithOtherSizes) {
  expectStablySorted(randomKeys(70'000, 18), 18);
  expectStablySorted(randomKeys(700, 12), 12);
  expectStablySorted(randomKeys(7'000, 18), 18);
}

}  // namespace
}  // namespace importon
