#include "render/film/error_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace importon::error_estimate_test {
namespace {

constexpr int kWidth = 64, kHeight = 48;

/// Truth 1, plus `bias(x, y)` and normal noise.
template <class Bias>
std::vector<vec3> noisy(std::mt19937& generator, float noise, const Bias& bias) {
  std::normal_distribution<float> normal(0, 1);
  std::vector<vec3> image;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const float shift = 1 + bias(x, y);
      image.emplace_back(shift + noise * normal(generator), shift + noise * normal(generator),
                         shift + noise * normal(generator));
    }
  return image;
}

constexpr auto kNone = [](int, int) { return 0.F; };
/// A smooth bias of mean square 0.04²/2.
constexpr auto kWave = [](int x, int) { return 0.04F * std::sin(0.1F * static_cast<float>(x)); };

// Two pixels, halves (1, 3) and (2, 2): means 2; (A-B)²/4 is 1 and 0 … denominators 4.04: (1/4.04)/2.
TEST(ErrorEstimate, HasTheValueWorkedByHand) {
  const std::vector<vec3> even{vec3(1), vec3(2)}, odd{vec3(3), vec3(2)};
  const ErrorEstimate estimate = estimateErrors({even, odd}, {even, odd}, 2);
  EXPECT_NEAR(estimate.noise, std::sqrt(0.5 / 4.04), 1e-9);
  EXPECT_EQ(estimate.bias, 0);
  EXPECT_EQ(estimate.relative, estimate.noise);
  ASSERT_EQ(estimate.perPixel.size(), 2u);
  EXPECT_NEAR(estimate.perPixel[0].x, std::sqrt(0.5), 1e-6);  // the window holds both
}

// With shares 1/4 and 3/4: means 2.5 and 2, the variance 3/16 (A-B)².
TEST(ErrorEstimate, WeighsHalvesByTheirShares) {
  const std::vector<vec3> even{vec3(1), vec3(2)}, odd{vec3(3), vec3(2)};
  const ErrorEstimate estimate = estimateErrors({even, odd, 0.25f}, {even, odd, 0.25f}, 2);
  const double floor = 0.01 * 2.25 * 2.25;
  EXPECT_NEAR(estimate.noise, std::sqrt(0.5 * 0.75 / (2.5 * 2.5 + floor)), 1e-9);
}

// Halves of noise 0.2: their mean has 0.2/sqrt(2), over the root of the mean of 1/(I² + 0.01). Of 9216 values of chi²
// with one degree the mean is known to 1.5 %, so the root to 0.75 %, and trimming takes less than 1 %: within 4 %.
TEST(ErrorEstimate, FindsTheNoise) {
  std::mt19937 generator(1);
  const auto even = noisy(generator, 0.2F, kNone), odd = noisy(generator, 0.2F, kNone);
  const ErrorEstimate estimate = estimateErrors({even, odd}, {even, odd}, kWidth);
  EXPECT_NEAR(estimate.relative, 0.2 / std::sqrt(2) / std::sqrt(1.01), 0.04 * 0.141);
}

// Little noise left, much taken away by sharing that moved the image by a smooth wave: the product of the halves'
// differences has mean 0.04²/2 over blocks, each with the noise of 16 pixels.
TEST(ErrorEstimate, FindsTheBiasUnderTheNoise) {
  std::mt19937 generator(2);
  const auto even = noisy(generator, 0.01F, kWave), odd = noisy(generator, 0.01F, kWave);
  const auto rawEven = noisy(generator, 0.1F, kNone), rawOdd = noisy(generator, 0.1F, kNone);
  const ErrorEstimate estimate = estimateErrors({even, odd}, {rawEven, rawOdd}, kWidth);
  // Squared bias: 8e-4/1.01; its standard error over 192 blocks of three channels is 0.1²/16/sqrt(576), five of them.
  EXPECT_NEAR(estimate.bias * estimate.bias, 8e-4 / 1.01, 5 * 0.01 / 16 / std::sqrt(576.0) + 1e-5);
  EXPECT_NEAR(estimate.relative, std::hypot(estimate.noise, estimate.bias), 1e-12);
}

TEST(ErrorEstimate, FindsNoBiasWhereThereIsNone) {
  std::mt19937 generator(3);
  const auto even = noisy(generator, 0.01F, kNone), odd = noisy(generator, 0.01F, kNone);
  const auto rawEven = noisy(generator, 0.1F, kNone), rawOdd = noisy(generator, 0.1F, kNone);
  const double bias = estimateErrors({even, odd}, {rawEven, rawOdd}, kWidth).bias;
  EXPECT_LT(bias * bias, 5 * 0.01 / 16 / std::sqrt(576.0));
}

TEST(ErrorEstimate, TellsWhereTheErrorIs) {
  std::mt19937 generator(4);
  auto even = noisy(generator, 0.01F, kNone), odd = noisy(generator, 0.01F, kNone);
  for (int y = 0; y < kHeight; ++y)
    for (int x = kWidth / 2; x < kWidth; ++x) {
      const auto i = static_cast<std::size_t>(y * kWidth + x);
      even[i] = vec3(1) + 20.F * (even[i] - vec3(1));
      odd[i] = vec3(1) + 20.F * (odd[i] - vec3(1));
    }
  const ErrorEstimate estimate = estimateErrors({even, odd}, {even, odd}, kWidth);
  const std::size_t middle = static_cast<std::size_t>(kHeight / 2 * kWidth);
  EXPECT_GT(estimate.perPixel[middle + 3 * kWidth / 4].x, 8 * estimate.perPixel[middle + kWidth / 4].x);
}

TEST(ErrorEstimate, OfABlackImageIsZero) {
  const std::vector<vec3> black(12, vec3(0));
  const ErrorEstimate estimate = estimateErrors({black, black}, {black, black}, 4);
  EXPECT_EQ(estimate.relative, 0);
}

}  // namespace
}  // namespace importon::error_estimate_test
