// lib/sequence.glsl: points that are evenly spread within a pair of dimensions, and independent across pairs and
// streams. Significance of each statistical test: 1e-4.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shared/render_data.h"
#include "support/gpu_test.h"
#include "support/statistics.h"
#include "test_kernels/registry.h"

namespace importon::sequence_test {
namespace {

constexpr double kSignificance = 1e-4;

/// As in tests/kernels/sequence.comp.
struct Key {
  uint seed, stream, index, pair;
};

class Sequence : public test::GpuTest {
 protected:
  [[nodiscard]] std::vector<vec2> points(const std::vector<Key>& keys) const {
    return test::runKernel<vec2>(context(), test_kernels::code("sequence"), keys);
  }
};

/// Items are whole numbers of 32 bits, also negative ones; what they are counted from has 64.
TEST_F(Sequence, LongIndicesCarryAndBorrow) {
  constexpr uint kLong = 0xFFFFFFFFu;  // asks for a long index
  const std::vector<Key> keys{{5, 7, 9, kLong}, {0xFFFFFFFEu, 0, 3, kLong}, {1, 1, 0xFFFFFFFEu, kLong}};
  const vec2 expected[] = {{14, 7}, {1, 1}, {4294967295.0f, 0}};  // low and high word
  const auto found = points(keys);
  for (std::size_t i = 0; i < keys.size(); ++i) EXPECT_EQ(found[i], expected[i]) << i;
}

std::vector<Key> oneStream(uint stream, uint pair, uint first, uint count) {
  std::vector<Key> keys;
  for (uint i = 0; i < count; ++i) keys.push_back({5, stream, first + i, pair});
  return keys;
}

/// The n-th point of as many streams.
std::vector<Key> manyStreams(uint pair, uint index, uint count) {
  std::vector<Key> keys;
  for (uint i = 0; i < count; ++i) keys.push_back({5, i, index, pair});
  return keys;
}

/// p of the hypothesis that (a, b) is uniform in the unit square, by 16 x 16 cells.
double uniformity(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr std::size_t kSide = 16;
  std::vector<double> observed(kSide * kSide), expected(kSide * kSide, static_cast<double>(a.size()) / (kSide * kSide));
  for (std::size_t i = 0; i < a.size(); ++i)
    ++observed[static_cast<std::size_t>(a[i] * kSide) * kSide + static_cast<std::size_t>(b[i] * kSide)];
  return test::chiSquareTest(observed, expected).pValue;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - 0.5) * (b[i] - 0.5);
  return 12 * sum / static_cast<double>(a.size());
}

std::vector<double> coordinate(const std::vector<vec2>& points, int axis) {
  std::vector<double> values;
  for (const vec2& p : points) values.push_back(p[axis]);
  return values;
}

TEST_F(Sequence, StaysInTheUnitSquare) {
  for (const vec2& p : points(oneStream(1, 0, 0xFFFF0000u, 0x10000u))) {
    ASSERT_GE(std::min(p.x, p.y), 0.0f);
    ASSERT_LT(std::max(p.x, p.y), 1.0f);
  }
}

TEST_F(Sequence, HasOnePointInEachElementaryIntervalOfAnyAlignedBlock) {
  for (const uint m : {4u, 8u, 11u}) {
    const uint count = 1u << m;
    for (const uint first : {0u, 3 * count, 0x80000000u}) {
      for (const uint pair : {0u, 1u, 9u}) {
        const auto block = points(oneStream(77, pair, first, count));
        for (uint split = 0; split <= m; ++split) {  // 2^split columns, 2^(m-split) rows
          std::vector<int> hits(count);
          for (const vec2& p : block) {
            const uint x = static_cast<uint>(std::ldexp(static_cast<double>(p.x), static_cast<int>(split)));
            const uint y = static_cast<uint>(std::ldexp(static_cast<double>(p.y), static_cast<int>(m - split)));
            ++hits[(x << (m - split)) | y];
          }
          ASSERT_EQ(std::count(hits.begin(), hits.end(), 1), count) << "2^" << m << " points, split " << split;
        }
      }
    }
  }
}

TEST_F(Sequence, EachPointIsUniformOverStreams) {
  for (const uint index : {0u, 1u, 63u}) {
    for (const uint pair : {0u, 4u}) {
      const auto p = points(manyStreams(pair, index, 100'000));
      EXPECT_GT(uniformity(coordinate(p, 0), coordinate(p, 1)), kSignificance)
          << "point " << index << ", pair " << pair;
    }
  }
}

TEST_F(Sequence, PairsAreIndependentOverStreams) {
  for (const uint index : {0u, 5u}) {
    const auto first = points(manyStreams(0, index, 100'000));
    for (uint pair = 1; pair < 5; ++pair) {
      const auto second = points(manyStreams(pair, index, 100'000));
      for (int a = 0; a < 2; ++a) {
        for (int b = 0; b < 2; ++b)
          EXPECT_GT(uniformity(coordinate(first, a), coordinate(second, b)), kSignificance) << "pair " << pair;
      }
    }
  }
}

// Along one stream two pairs are shuffled, not random, against one another: chi-square does not hold, but there
// must be no correlation.
TEST_F(Sequence, PairsOfOneStreamAreNotCorrelated) {
  constexpr uint kCount = 1u << 16;
  for (const uint stream : {3u, 4u, 1000u}) {
    const auto first = points(oneStream(stream, 0, 0, kCount));
    for (uint pair = 1; pair < 6; ++pair) {
      const auto second = points(oneStream(stream, pair, 0, kCount));
      for (int a = 0; a < 2; ++a) {
        for (int b = 0; b < 2; ++b) {
          const double r = correlation(coordinate(first, a), coordinate(second, b));
          EXPECT_LT(std::abs(r) * std::sqrt(kCount), 4.5) << "pair " << pair;
        }
      }
    }
  }
}

TEST_F(Sequence, NeighbouringPixelsOfOnePassAreIndependent) {
  const auto p = points(manyStreams(1, 0, 100'001));
  const std::vector<double> x = coordinate(p, 0), y = coordinate(p, 1);
  const std::vector<double> left(x.begin(), x.end() - 1), right(x.begin() + 1, x.end());
  EXPECT_GT(uniformity(left, right), kSignificance);
  EXPECT_GT(uniformity({y.begin(), y.end() - 1}, {y.begin() + 1, y.end()}), kSignificance);
}

TEST_F(Sequence, OtherSeedsGiveOtherPoints) {
  const auto a = points({{1, 2, 3, 4}}), b = points({{2, 2, 3, 4}});
  EXPECT_NE(a, b);
}

}  // namespace
}  // namespace importon::sequence_test
