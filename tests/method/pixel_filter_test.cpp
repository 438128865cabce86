// lib/pixel_filter.glsl: points have the filter's density. Significance of each test: 1e-4.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "shared/features.h"
#include "support/gpu_test.h"
#include "support/statistics.h"
#include "test_kernels/registry.h"

namespace importon::pixel_filter_test {
namespace {

/// As in tests/kernels/pixel_filter.comp.
struct Query {
  vec2 u;
  uint kind;
};

constexpr double kRadius = 1.5, kSigma = 0.5;  // pixels

double gaussian(double x, double y) {
  const double square = x * x + y * y;
  return square < kRadius * kRadius ? std::exp(-0.5 * square / (kSigma * kSigma)) : 0;
}

double blackmanHarris(double x) {
  const double phase = M_PI * (x / kRadius + 1);
  return 0.35875 - 0.48829 * std::cos(phase) + 0.14128 * std::cos(2 * phase) - 0.01168 * std::cos(3 * phase);
}

class PixelFilters : public test::GpuTest {
 protected:
  /// That points, in 24 x 24 cells over the filter's width, fall as `density` says.
  void expectDensity(uint kind, const std::function<double(double, double)>& density) const {
    constexpr int kSide = 24, kFine = 8, kSamples = 200'000;
    std::mt19937 random(kind + 1);
    std::uniform_real_distribution<float> unit(0, 0.99999994f);
    std::vector<Query> queries(kSamples);
    for (Query& q : queries) q = {vec2(unit(random), unit(random)), kind};
    std::vector<double> counts(kSide * kSide), expected(kSide * kSide);
    for (const vec2& p : test::runKernel<vec2>(context(), test_kernels::code("pixel_filter"), queries)) {
      const glm::dvec2 cell = (glm::dvec2(p) - 0.5 + kRadius) / (2 * kRadius) * static_cast<double>(kSide);
      ASSERT_TRUE(cell.x > -1e-4 && cell.x < kSide + 1e-4 && cell.y > -1e-4 && cell.y < kSide + 1e-4);
      const auto index = [](double c) { return std::clamp(static_cast<int>(c), 0, kSide - 1); };
      ++counts[static_cast<std::size_t>(index(cell.y) * kSide + index(cell.x))];
    }
    double sum = 0;
    for (int j = 0; j < kSide * kFine; ++j) {
      for (int i = 0; i < kSide * kFine; ++i) {
        const auto at = [](int k) { return kRadius * (2 * (k + 0.5) / (kSide * kFine) - 1); };
        const double value = density(at(i), at(j));
        expected[static_cast<std::size_t>(j / kFine * kSide + i / kFine)] += value;
        sum += value;
      }
    }
    for (double& e : expected) e *= kSamples / sum;
    EXPECT_GT(test::chiSquareTest(counts, expected).pValue, 1e-4);
  }
};

TEST_F(PixelFilters, BoxIsThePixel) {
  expectDensity(kFilterBox, [](double x, double y) { return std::max(std::abs(x), std::abs(y)) < 0.5 ? 1.0 : 0.0; });
}

TEST_F(PixelFilters, GaussianFallsAsItSays) { expectDensity(kFilterGaussian, gaussian); }

TEST_F(PixelFilters, BlackmanHarrisFallsAsItSays) {
  expectDensity(kFilterBlackmanHarris, [](double x, double y) { return blackmanHarris(x) * blackmanHarris(y); });
}

}  // namespace
}  // namespace importon::pixel_filter_test
