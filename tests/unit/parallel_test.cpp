#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <vector>

namespace importon {
namespace {

TEST(Parallel, VisitsEveryIndexOnce) {
  for (const int threads : {0, 1, 2, 7}) {
    std::vector<std::atomic<int>> visits(10'001);
    parallelFor(visits.size(), 64, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++visits[i];
    });
    for (const auto& visit : visits) ASSERT_EQ(visit, 1);
  }
}

TEST(Parallel, CutsTheSameChunksWhateverTheThreads) {
  const auto chunksWith = [](int threads) {
    std::mutex mutex;
    std::set<std::pair<std::size_t, std::size_t>> chunks;
    parallelFor(1000, 300, threads, [&](std::size_t begin, std::size_t end) {
      const std::lock_guard lock(mutex);
      chunks.emplace(begin, end);
    });
    return chunks;
  };
  const std::set<std::pair<std::size_t, std::size_t>> expected{{0, 300}, {300, 600}, {600, 900}, {900, 1000}};
  EXPECT_EQ(chunksWith(1), expected);
  EXPECT_EQ(chunksWith(4), expected);
}

TEST(Parallel, DoesNothingForNoItems) {
  bool wasCalled = false;
  parallelFor(0, 8, 0, [&](std::size_t, std::size_t) { wasCalled = true; });
  EXPECT_FALSE(wasCalled);
}

TEST(Parallel, PassesOnAnException) {
  const auto failing = [](std::size_t begin, std::size_t) {
    if (begin == 500) throw std::runtime_error("here");
  };
  EXPECT_THROW(parallelFor(1000, 10, 4, failing), std::runtime_error);
  EXPECT_THROW(parallelFor(1000, 10, 1, failing), std::runtime_error);
}

TEST(Parallel, CountsNoMoreThreadsThanThereAre) {
  EXPECT_GE(threadCount(0), 1);
  EXPECT_EQ(threadCount(1), 1);
  EXPECT_EQ(threadCount(1'000'000), threadCount(0));
}

}  // namespace
}  // namespace importon
