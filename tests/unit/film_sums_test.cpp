#include "render/film/film_sums.h"

#include <gtest/gtest.h>

#include <cstring>

namespace importon::film_sums_test {
namespace {

constexpr std::size_t kFloats = sizeof(FilmPixel) / sizeof(float);

/// A film of two pixels of which the n-th number of all is `first` + n.
FilmSums film(float first, std::uint64_t even, std::uint64_t odd, std::uint32_t seed) {
  FilmSums sums;
  sums.halves.resize(4);
  std::vector<float> values(4 * kFloats);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = first + static_cast<float>(i);
  std::memcpy(sums.halves.data(), values.data(), values.size() * sizeof(float));
  sums.evenSamples = even;
  sums.oddSamples = odd;
  sums.passes = 2;
  sums.seeds = {seed};
  return sums;
}

std::vector<float> valuesOf(const FilmSums& sums) {
  std::vector<float> values(sums.halves.size() * kFloats);
  std::memcpy(values.data(), sums.halves.data(), values.size() * sizeof(float));
  return values;
}

TEST(FilmSums, AddEveryNumberOfEveryPixel) {
  FilmSums sum = film(1, 4, 2, 7);
  sum.add(film(1000, 8, 3, 9), 2);
  const std::vector<float> values = valuesOf(sum);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i], 1001 + 2 * static_cast<float>(i)) << i;
  EXPECT_EQ(sum.evenSamples, 12u);
  EXPECT_EQ(sum.oddSamples, 5u);
  EXPECT_EQ(sum.passes, 4u);
  EXPECT_EQ(sum.seeds, (std::vector<std::uint32_t>{7, 9}));
}

TEST(FilmSums, AddWhatPixelsHaveBeyondTheMean) {
  FilmSums sum = film(1, 4, 2, 0), other = film(1, 4, 2, 1);
  other.evenExtra = {1, -1};
  other.oddExtra = {-2, 2};
  sum.add(other, 1);
  sum.add(other, 1);
  sum.add(film(1, 4, 2, 2), 1);
  EXPECT_EQ(sum.evenExtra, (std::vector<std::int32_t>{2, -2}));
  EXPECT_EQ(sum.counts().odd(1), 6 + 2 * 2 + 2);
}

TEST(FilmSums, HalvesChangePlacesWithTheirCounts) {
  FilmSums sum = film(0, 4, 2, 0);
  sum.evenExtra = {1, -1};
  sum.oddExtra = {3, -3};
  const std::vector<float> before = valuesOf(sum);
  sum.swapHalves();
  const std::vector<float> after = valuesOf(sum);
  for (std::size_t i = 0; i < after.size(); ++i) EXPECT_EQ(after[i], before[(i + after.size() / 2) % after.size()]);
  EXPECT_EQ(sum.counts().even(0), 2 + 3);
  EXPECT_EQ(sum.counts().odd(1), 4 - 1);
}

}  // namespace
}  // namespace importon::film_sums_test
