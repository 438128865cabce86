#include "render/film/adaptive_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace importon::adaptive_sampler_test {
namespace {

constexpr int kWidth = 16, kHeight = 12;
constexpr std::size_t kPixels = kWidth * kHeight;
constexpr std::uint64_t kSamples = 8;  // in each half

/// Pixels of radiance 1, of no variance but for `noisy` ones.
std::vector<FilmPixel> filmOf(const std::function<bool(std::size_t)>& noisyInEven,
                              const std::function<bool(std::size_t)>& noisyInOdd) {
  std::vector<FilmPixel> halves(2 * kPixels);
  for (std::size_t i = 0; i < halves.size(); ++i) {
    const bool isNoisy = i < kPixels ? noisyInEven(i) : noisyInOdd(i - kPixels);
    halves[i].direct = vec3(static_cast<float>(kSamples));
    halves[i].foundSquare = static_cast<float>(kSamples) * (isNoisy ? 3.0f : 1.0f);
    halves[i].square = vec3(halves[i].foundSquare);
  }
  return halves;
}

bool isOnTheLeft(std::size_t i) { return i % kWidth < kWidth / 4; }
bool isNowhere(std::size_t) { return false; }

/// Paths of each pixel in one pass.
std::vector<uint> pathsOf(const std::vector<uvec2>& firstPaths) {
  std::vector<uint> paths;
  for (std::size_t i = 0; i + 1 < firstPaths.size(); ++i) paths.push_back(firstPaths[i + 1].x - firstPaths[i].x);
  return paths;
}

TEST(AdaptiveSampler, LearnsWhenPassesHaveDoubled) {
  for (const int pass : {4, 8, 16, 1024}) EXPECT_TRUE(AdaptiveSampler::learnsBefore(pass)) << pass;
  for (const int pass : {0, 1, 2, 3, 5, 6, 12}) EXPECT_FALSE(AdaptiveSampler::learnsBefore(pass)) << pass;
}

TEST(AdaptiveSampler, GivesNoisyPixelsMoreAndOthersTheirQuarter) {
  AdaptiveSampler sampler(kWidth, kPixels);
  EXPECT_FALSE(sampler.hasLearned());
  sampler.learn(filmOf(isOnTheLeft, isOnTheLeft), kSamples, kSamples, 1);
  const auto paths = pathsOf(sampler.distribute(4, 16, 0, kPixels));
  // Of a row of 16 pixels, three have the whole noise, one two thirds of its square and one a third.
  const double mean = (3 + std::sqrt(2 / 3.0) + std::sqrt(1 / 3.0)) / kWidth;
  EXPECT_NEAR(paths[5 * kWidth], 16 * (0.25 + 0.75 / mean), 1);
  EXPECT_NEAR(paths[5 * kWidth + 12], 4, 1);
}

TEST(AdaptiveSampler, OfAHalfDependsOnTheOtherHalfAlone) {
  AdaptiveSampler sampler(kWidth, kPixels);
  sampler.learn(filmOf(isOnTheLeft, isNowhere), kSamples, kSamples, 1);
  for (const uint paths : pathsOf(sampler.distribute(4, 4, 0, kPixels)))
    EXPECT_NEAR(paths, 4, 1) << "even passes saw noise, odd ones none";
  EXPECT_GT(pathsOf(sampler.distribute(5, 4, 0, kPixels))[0], 8u);
}

TEST(AdaptiveSampler, DealsTheBudgetAndItsSharesInTheLongRun) {
  AdaptiveSampler sampler(kWidth, kPixels);
  sampler.learn(filmOf(isOnTheLeft, isOnTheLeft), kSamples, kSamples, 1);
  std::vector<double> sums(kPixels), shares(kPixels);
  constexpr int kPasses = 200;
  for (int pass = 4; pass < 4 + 2 * kPasses; pass += 2) {
    const auto firstPaths = sampler.distribute(pass, 2, 0, kPixels);
    EXPECT_LE(firstPaths.back().x, 2 * kPixels) << "more than there is memory for";
    EXPECT_GE(firstPaths.back().x, 2 * kPixels - 2);
    const auto paths = pathsOf(firstPaths);
    for (std::size_t i = 0; i < kPixels; ++i) sums[i] += paths[i];
  }
  for (std::size_t i = kWidth; i < 2 * kWidth; ++i) EXPECT_NEAR(sums[i], sums[i + kWidth], 3) << "rows are alike";
  const SampleCounts counts = sampler.counts(kSamples + 2 * kPasses, kSamples);
  for (std::size_t i = 0; i < kPixels; ++i) {
    EXPECT_EQ(counts.even(i), kSamples + sums[i]);
    EXPECT_EQ(counts.odd(i), kSamples);
  }
}

TEST(AdaptiveSampler, NumbersThePathsOfAPixelOneAfterTheOther) {
  AdaptiveSampler sampler(kWidth, kPixels);
  sampler.learn(filmOf(isOnTheLeft, isOnTheLeft), kSamples, kSamples, 1);
  std::vector<int> next(kPixels);  // beyond those of the mean, as they were before the pass
  for (int pass = 4; pass < 10; ++pass) {
    const auto firstPaths = sampler.distribute(pass, 4, 0, kPixels);
    for (std::size_t i = 0; i < kPixels; ++i) {
      EXPECT_EQ(static_cast<int>(firstPaths[i].y), next[i]);
      next[i] += static_cast<int>(firstPaths[i + 1].x - firstPaths[i].x) - 4;
    }
  }
}

TEST(AdaptiveSampler, TakesNoisyIndirectLightAtItsShare) {
  std::vector<FilmPixel> film = filmOf(isNowhere, isNowhere);
  for (std::size_t i = 0; i < film.size(); ++i)
    if (isOnTheLeft(i % kPixels))
      film[i].square = vec3(3 * static_cast<float>(kSamples));
    else
      film[i].square = vec3(2 * static_cast<float>(kSamples)), film[i].foundSquare = 2 * static_cast<float>(kSamples);
  AdaptiveSampler whole(kWidth, kPixels), small(kWidth, kPixels);
  whole.learn(film, kSamples, kSamples, 1);
  small.learn(film, kSamples, kSamples, 1.0f / 16);
  const auto far = [](AdaptiveSampler& sampler) {
    const auto paths = pathsOf(sampler.distribute(4, 64, 0, kPixels));
    return static_cast<double>(paths[5 * kWidth]) / paths[5 * kWidth + 12];
  };
  EXPECT_GT(far(whole), 1.2);
  EXPECT_LT(far(small), 0.6);
}

// All gather alike, but those on the left see several surfaces.
TEST(AdaptiveSampler, TakesIndirectLightWholeOnEdges) {
  std::vector<FilmPixel> film = filmOf(isNowhere, isNowhere);
  for (std::size_t i = 0; i < film.size(); ++i) {
    film[i].square = vec3(3 * static_cast<float>(kSamples));
    film[i].gathers = static_cast<float>(kSamples);
    film[i].normal = vec3(0, 0, film[i].gathers * (isOnTheLeft(i % kPixels) ? 0.7f : 1.0f));
  }
  AdaptiveSampler sampler(kWidth, kPixels);
  sampler.learn(film, kSamples, kSamples, 1.0f / 16);
  const auto paths = pathsOf(sampler.distribute(4, 64, 0, kPixels));
  EXPECT_GT(paths[5 * kWidth], 2 * paths[5 * kWidth + 12]);
  sampler.learn(film, kSamples, kSamples, 1);
  for (const uint each : pathsOf(sampler.distribute(4, 64, 0, kPixels))) EXPECT_NEAR(each, 64, 1);
}

TEST(AdaptiveSampler, GoesOnAfterAPause) {
  AdaptiveSampler sampler(kWidth, kPixels), again(kWidth, kPixels), smaller(kWidth, kPixels / 2);
  EXPECT_TRUE(again.restore(sampler.save()));
  EXPECT_FALSE(again.hasLearned());
  sampler.learn(filmOf(isOnTheLeft, isOnTheLeft), kSamples, kSamples, 1);
  for (int pass = 4; pass < 7; ++pass) (void)sampler.distribute(pass, 4, 0, kPixels);
  EXPECT_TRUE(again.restore(sampler.save()));
  EXPECT_EQ(again.distribute(7, 4, 0, kPixels), sampler.distribute(7, 4, 0, kPixels));
  EXPECT_FALSE(smaller.restore(sampler.save()));
}

}  // namespace
}  // namespace importon::adaptive_sampler_test
