#include "support/special_functions.h"

#include <gtest/gtest.h>

#include <cmath>

namespace importon::test {
namespace {

TEST(RegularizedGammaQ, IsTheExponentialForOrderOne) {
  for (const double x : {0.0, 0.01, 0.5, 1.0, 1.99, 2.0, 2.01, 10.0, 100.0}) {
    EXPECT_NEAR(regularizedGammaQ(1.0, x), std::exp(-x), 1e-12 * std::exp(-x) + 1e-16) << x;
  }
}

TEST(RegularizedGammaQ, IsTheErrorFunctionForOrderOneHalf) {
  for (const double x : {0.001, 0.3, 1.0, 1.5, 4.0, 25.0}) {
    EXPECT_NEAR(regularizedGammaQ(0.5, x), std::erfc(std::sqrt(x)), 1e-14) << x;
  }
}

TEST(RegularizedGammaQ, SatisfiesItsRecurrence) {
  // Q(a + 1, x) = Q(a, x) + x^a e^-x / Γ(a + 1) [DLMF 8.8.6]
  for (const double a : {0.7, 3.0, 12.5, 80.0, 900.0}) {
    for (const double x : {0.5 * a, a, 1.5 * a}) {
      const double step = std::exp(a * std::log(x) - x - std::lgamma(a + 1.0));
      EXPECT_NEAR(regularizedGammaQ(a + 1.0, x), regularizedGammaQ(a, x) + step, 1e-11) << a << " " << x;
    }
  }
}

TEST(RegularizedBeta, IsAPowerWhenOneParameterIsOne) {
  for (const double x : {0.0, 0.1, 0.5, 0.77, 0.999, 1.0}) {
    EXPECT_NEAR(regularizedBeta(3.5, 1.0, x), std::pow(x, 3.5), 1e-13) << x;
    EXPECT_NEAR(regularizedBeta(1.0, 2.5, x), 1.0 - std::pow(1.0 - x, 2.5), 1e-13) << x;
  }
}

TEST(RegularizedBeta, IsSymmetric) {
  for (const double x : {0.05, 0.3, 0.5, 0.8}) {
    EXPECT_NEAR(regularizedBeta(2.3, 7.1, x) + regularizedBeta(7.1, 2.3, 1.0 - x), 1.0, 1e-13) << x;
  }
}

TEST(RegularizedBeta, IsTheArcSineLawForHalves) {
  const double pi = std::acos(-1.0);
  for (const double x : {0.02, 0.25, 0.5, 0.9}) {
    EXPECT_NEAR(regularizedBeta(0.5, 0.5, x), 2.0 / pi * std::asin(std::sqrt(x)), 1e-13) << x;
  }
}

}  // namespace
}  // namespace importon::test
