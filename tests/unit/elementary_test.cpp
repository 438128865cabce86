// Elementary functions against those of the host's library in double precision: the errors that
// shaders/shared/elementary.h states.
#include "shared/elementary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace importon {
namespace {

using namespace elementary;

constexpr int kSteps = 1 << 20;

struct Errors {
  double absolute = 0, ulps = 0;  // largest
};

/// Over steps from `low` to `high`; ulps are those of the result.
Errors errorsOf(const std::function<float(float)>& own, const std::function<double(double)>& exact, double low,
                double high) {
  Errors errors;
  for (int i = 0; i <= kSteps; ++i) {
    const auto x = static_cast<float>(low + (high - low) * i / kSteps);
    const double right = exact(x), error = std::abs(own(x) - right);
    const auto nearest = static_cast<float>(std::abs(right));
    const double ulp = std::nextafter(nearest, std::numeric_limits<float>::infinity()) - nearest;
    errors.absolute = std::max(errors.absolute, error);
    errors.ulps = std::max(errors.ulps, error / ulp);
  }
  return errors;
}

double exactCos(double x) { return std::cos(x); }
double exactSin(double x) { return std::sin(x); }

TEST(Elementary, CosineAndSineAreWithinTheirErrors) {
  for (const double range : {7.0, 100.0, 6000.0}) {
    EXPECT_LE(errorsOf(portableCos, exactCos, -range, range).absolute, 1e-7) << range;
    EXPECT_LE(errorsOf(portableSin, exactSin, -range, range).absolute, 1e-7) << range;
  }
  for (const float x : {1e6f, -1e20f, 3e38f}) EXPECT_LE(std::abs(portableCos(x)), 1) << x;
}

TEST(Elementary, ExponentialsAreWithinTheirErrors) {
  const auto exp = [](double x) { return std::exp(x); };
  const auto exp2 = [](double x) { return std::exp2(x); };
  EXPECT_LE(errorsOf(portableExp, exp, -85.9, 88.7).ulps, 2);
  EXPECT_LE(errorsOf(portableExp, exp, -1, 1).ulps, 2);
  EXPECT_LE(errorsOf(portableExp2, exp2, -124, 127.99).ulps, 2);
  for (int e = -124; e < 128; ++e) EXPECT_EQ(portableExp2(static_cast<float>(e)), std::ldexp(1.0f, e));
  EXPECT_EQ(portableExp(-90), 0);
  EXPECT_EQ(portableExp2(-1000), 0);
  EXPECT_EQ(portableExp(89), std::numeric_limits<float>::infinity());
  EXPECT_EQ(portableExp2(128), std::numeric_limits<float>::infinity());
}

TEST(Elementary, LogarithmsAreWithinTheirErrors) {
  const auto log = [](double x) { return std::log(x); };
  const auto log2 = [](double x) { return std::log2(x); };
  EXPECT_LE(errorsOf(portableLog, log, 0.5, 2).absolute, 1e-7);
  EXPECT_LE(errorsOf(portableLog, log, 2, 1e6).ulps, 2);
  EXPECT_LE(errorsOf(portableLog, log, 1e-30, 0.5).ulps, 2);
  EXPECT_LE(errorsOf(portableLog2, log2, 2, 1e6).ulps, 2);
  for (int e = -126; e < 128; ++e) EXPECT_EQ(portableLog2(std::ldexp(1.0f, e)), e);
}

TEST(Elementary, PowersAreWithinTheirErrors) {
  for (const float y : {0.2f, 0.5f, 2.4f, 30.0f})
    for (int i = 1; i <= kSteps; ++i) {
      const float x = 4.0f * static_cast<float>(i) / kSteps;
      const double right = std::pow(static_cast<double>(x), static_cast<double>(y));
      if (right < 1e-37) continue;
      ASSERT_LE(std::abs(portablePow(x, y) / right - 1), 1.5e-7 * (1 + std::abs(y * std::log2(x)))) << x << "^" << y;
    }
  EXPECT_EQ(portablePow(0, 0.2f), 0);
}

TEST(Elementary, AnglesAreWithinTheirErrors) {
  const auto acos = [](double x) { return std::acos(x); };
  EXPECT_LE(errorsOf(portableAcos, acos, -1, 1).absolute, 4e-7);
  EXPECT_EQ(portableAcos(1), 0);
  double largest = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double turn = 6.283185307179586 * i / kSteps, length = std::exp2(i % 60 - 30);
    const auto x = static_cast<float>(length * std::cos(turn)), y = static_cast<float>(length * std::sin(turn));
    largest =
        std::max(largest, std::abs(portableAtan(y, x) - std::atan2(static_cast<double>(y), static_cast<double>(x))));
  }
  EXPECT_LE(largest, 4e-7);
  EXPECT_EQ(portableAtan(0, 0), 0);
}

TEST(Elementary, IntegersBecomeTheFloatsNextToThem) {
  for (std::uint32_t i = 0; i < 1u << 20; ++i) {
    const std::uint32_t x = i * 2654435761u;
    ASSERT_EQ(portableFloat(x), static_cast<float>(x)) << x;
  }
}

}  // namespace
}  // namespace importon
