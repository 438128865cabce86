/// What a test shows by samples, as assertions that say their figures.
#pragma once
#include <gtest/gtest.h>

#include "support/statistics.h"

namespace importon::test {

/// The probability with which a claim passes although it is false: the mean is off by the margin, or at the bound.
inline constexpr double kClaimSignificance = 0.01;

/// The least probability with which a test of equality passes if the means are equal; below it the test fails, since it
/// had too few samples to show anything.
inline constexpr double kLeastPower = 0.9;

/// Shows that the mean is `expected` within a relative margin, by equivalenceTest.
[[nodiscard]] ::testing::AssertionResult isWithin(double margin, const Moments& values, double expected);

/// Shows that the mean of `a` is that of `b` within a relative margin.
[[nodiscard]] ::testing::AssertionResult areWithin(double margin, const Moments& a, const Moments& b);

/// Shows by Student's one-sided test that the mean is above, or below, a bound.
[[nodiscard]] ::testing::AssertionResult isAbove(double bound, const Moments& values);
[[nodiscard]] ::testing::AssertionResult isBelow(double bound, const Moments& values);

}  // namespace importon::test
