#include "support/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/claims.h"

namespace importon::test {
namespace {

/// In [0, 1), the same on every platform.
double uniform(std::mt19937_64& generator) { return std::ldexp(static_cast<double>(generator() >> 11), -53); }

/// 20 cells of unequal expectation, filled by 2000 samples of just those probabilities, scaled by `tilt` in the
/// lower half of the cells.
struct Histogram {
  std::vector<double> observed, expected;
};
Histogram sampleHistogram(std::mt19937_64& generator, double tilt) {
  constexpr int kCells = 20, kSamples = 2000;
  Histogram histogram{std::vector<double>(kCells, 0.0), {}};
  std::vector<double> cumulative;
  double total = 0, tilted = 0;
  for (int i = 0; i < kCells; ++i) total += i + 1;
  for (int i = 0; i < kCells; ++i) {
    histogram.expected.push_back(kSamples * (i + 1) / total);
    tilted += (i + 1) * (i < kCells / 2 ? tilt : 1.0);
    cumulative.push_back(tilted);
  }
  for (int k = 0; k < kSamples; ++k) {
    const double x = uniform(generator) * tilted;
    std::size_t cell = 0;
    while (cumulative[cell] <= x) ++cell;
    histogram.observed[cell] += 1;
  }
  return histogram;
}

TEST(Moments, MatchTheDefinitionFarFromZero) {
  const std::vector<double> values = {1e9 + 4, 1e9 + 7, 1e9 + 13, 1e9 + 16};
  const Moments moments = momentsOf(values);
  EXPECT_EQ(moments.count(), 4);
  EXPECT_DOUBLE_EQ(moments.mean(), 1e9 + 10);
  EXPECT_DOUBLE_EQ(moments.variance(), 30.0);
  EXPECT_DOUBLE_EQ(moments.standardError(), std::sqrt(30.0 / 4.0));
}

TEST(Moments, MergedPartsEqualTheWhole) {
  const std::vector<double> values = {3, -1, 4, 1, -5, 9, 2, 6};
  const std::span<const double> all(values);
  for (std::size_t cut = 0; cut <= values.size(); ++cut) {
    Moments merged = momentsOf(all.first(cut));
    merged.merge(momentsOf(all.subspan(cut)));
    EXPECT_EQ(merged.count(), 8);
    EXPECT_NEAR(merged.mean(), momentsOf(all).mean(), 1e-14) << cut;
    EXPECT_NEAR(merged.variance(), momentsOf(all).variance(), 1e-12) << cut;
  }
}

TEST(Moments, OfFewerThanTwoValuesHaveNoSpread) {
  EXPECT_EQ(Moments().standardError(), 0.0);
  EXPECT_EQ(momentsOf(std::vector<float>{2.5f}).mean(), 2.5);
  EXPECT_EQ(momentsOf(std::vector<float>{2.5f}).variance(), 0.0);
}

TEST(Moments, OfRatiosTakePairs) {
  const std::vector<double> a = {2, 6, 3}, b = {1, 2, 1}, two = {1, 2};
  EXPECT_EQ(ratiosOf(a, b).count(), 3);
  EXPECT_DOUBLE_EQ(ratiosOf(a, b).mean(), 8.0 / 3);
  EXPECT_THROW(static_cast<void>(ratiosOf(a, two)), std::invalid_argument);
}

TEST(ChiSquareTest, AgreesWithPublishedTables) {
  // Six faces of a die; upper 5 % point of 5 degrees of freedom: 11.0705.
  const std::vector<double> expected(6, 100.0);
  const double d = std::sqrt(11.070497693516351 * 100.0 / 2.0);
  const std::vector<double> observed = {100 + d, 100 - d, 100, 100, 100, 100};
  const TestResult result = chiSquareTest(observed, expected);
  EXPECT_EQ(result.degreesOfFreedom, 5.0);
  EXPECT_NEAR(result.statistic, 11.0704976935, 1e-9);
  EXPECT_NEAR(result.pValue, 0.05, 1e-9);
}

TEST(ChiSquareTest, PoolsCellsThatExpectTooLittle) {
  const std::vector<double> expected = {50, 1, 2, 2.5, 40, 1.5, 3};
  const std::vector<double> observed = {50, 9, 0, 0, 40, 1, 0};
  // 1 + 1.5 + 2 + 2.5 >= 5 and the rest, 3, goes with 40 on: {7, 43, 50}.
  const TestResult result = chiSquareTest(observed, expected);
  EXPECT_EQ(result.degreesOfFreedom, 2.0);
  EXPECT_NEAR(result.statistic, 9.0 / 7.0 + 9.0 / 43.0, 1e-12);
}

TEST(ChiSquareTest, FailsOnASampleWhereNothingIsExpected) {
  const std::vector<double> expected = {1000, 1000, 0};
  const std::vector<double> observed = {1000, 999, 1};
  EXPECT_EQ(chiSquareTest(observed, expected).pValue, 0.0);
}

TEST(ChiSquareTest, TakesFittedParametersOffTheDegreesOfFreedom) {
  const std::vector<double> expected(8, 25.0);
  EXPECT_EQ(chiSquareTest(expected, expected, 2).degreesOfFreedom, 5.0);
  EXPECT_EQ(chiSquareTest(expected, expected, 2).pValue, 1.0);
}

TEST(ChiSquareTest, RefusesWhatItCannotCompare) {
  const std::vector<double> two = {10, 10}, three = {10, 10, 10}, negative = {30, -10}, more = {10, 11};
  EXPECT_THROW(static_cast<void>(chiSquareTest(two, three)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(chiSquareTest(two, negative)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(chiSquareTest(two, more)), std::invalid_argument);
}

TEST(ChiSquareTest, RejectsRightSamplesAsOftenAsItsSignificanceSays) {
  std::mt19937_64 generator(1);
  constexpr int kRuns = 2000;
  int rejected = 0;
  for (int run = 0; run < kRuns; ++run) {
    const Histogram histogram = sampleHistogram(generator, 1.0);
    rejected += chiSquareTest(histogram.observed, histogram.expected).pValue < 0.05;
  }
  // Binomial with n = 2000, p = 0.05; 4 standard deviations.
  EXPECT_NEAR(rejected, 100, 4 * std::sqrt(2000 * 0.05 * 0.95));
}

TEST(ChiSquareTest, RejectsWrongSamples) {
  std::mt19937_64 generator(2);
  const Histogram histogram = sampleHistogram(generator, 1.5);
  EXPECT_LT(chiSquareTest(histogram.observed, histogram.expected).pValue, 1e-6);
}

TEST(ZTest, AgreesWithPublishedTables) {
  EXPECT_NEAR(zTest(1.959963984540054, 1.0, 0.0).pValue, 0.05, 1e-12);
  EXPECT_NEAR(zTest(5.0, 2.0, 5.0 + 2.0 * 2.5758293035489).pValue, 0.01, 1e-12);
  EXPECT_LT(zTest(5.0, 2.0, 9.0).statistic, 0.0);
}

TEST(ZTest, ComparesExactlyWithoutAnError) {
  EXPECT_EQ(zTest(1.0, 0.0, 1.0).pValue, 1.0);
  EXPECT_EQ(zTest(1.0, 0.0, 1.0 + 1e-15).pValue, 0.0);
}

TEST(ZTest, AddsTheVariancesOfTwoEstimates) {
  const TestResult result = zTest(10.0, 3.0, 0.0, 4.0);
  EXPECT_DOUBLE_EQ(result.statistic, 2.0);
}

TEST(TTest, AgreesWithPublishedTables) {
  // Two values: one degree of freedom, a Cauchy distribution; t = 12.7062 has p = 0.05.
  const std::vector<double> values = {12.706204736174698 - 1.0, 12.706204736174698 + 1.0};
  const TestResult result = tTest(momentsOf(values), 0.0);
  EXPECT_EQ(result.degreesOfFreedom, 1.0);
  EXPECT_NEAR(result.statistic, 12.706204736174698, 1e-12);
  EXPECT_NEAR(result.pValue, 0.05, 1e-12);
}

TEST(TTest, NeedsTwoValues) {
  const Moments one = momentsOf(std::vector<double>{1.0});
  EXPECT_THROW(static_cast<void>(tTest(one, 1.0)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(welchTest(one, one)), std::invalid_argument);
}

TEST(WelchTest, EqualsStudentsTestForLikeSamples) {
  const std::vector<double> a = {1, 2, 3, 4, 5, 6}, b = {3, 4, 5, 6, 7, 8};
  // Pooled variance 3.5, six values each: t = -2 / sqrt(3.5/3), 10 degrees of freedom.
  const TestResult result = welchTest(momentsOf(a), momentsOf(b));
  EXPECT_NEAR(result.statistic, -2.0 / std::sqrt(3.5 / 3.0), 1e-12);
  EXPECT_NEAR(result.degreesOfFreedom, 10.0, 1e-12);
  EXPECT_NEAR(result.pValue, 0.0933, 5e-4);
}

TEST(WelchTest, RejectsEqualMeansOfUnequalSpreadAsOftenAsItsSignificanceSays) {
  std::mt19937_64 generator(3);
  constexpr int kRuns = 2000;
  int rejected = 0;
  for (int run = 0; run < kRuns; ++run) {
    Moments wide, narrow;
    for (int i = 0; i < 10; ++i) wide.add(10.0 * (uniform(generator) + uniform(generator) + uniform(generator)));
    for (int i = 0; i < 60; ++i) narrow.add(15.0 + (uniform(generator) - uniform(generator)));
    rejected += welchTest(wide, narrow).pValue < 0.05;
  }
  // As above, and 0.01 for the values not being normal.
  EXPECT_NEAR(rejected, 100, 4 * std::sqrt(2000 * 0.05 * 0.95) + 0.01 * kRuns);
}

/// Sums of twelve uniform values: nearly normal, of variance 1.
double normal(std::mt19937_64& generator) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += uniform(generator);
  return sum;
}

Moments normalSample(std::mt19937_64& generator, int count, double mean, double deviation) {
  Moments values;
  for (int i = 0; i < count; ++i) values.add(mean + deviation * normal(generator));
  return values;
}

TEST(StudentPoint, AgreesWithPublishedTables) {
  EXPECT_NEAR(studentPoint(0.025, 1), 12.7062047362, 1e-9);
  EXPECT_NEAR(studentPoint(0.01, 14), 2.62449406759, 1e-9);
  EXPECT_NEAR(studentPoint(0.05, 120), 1.65765, 1e-5);
  EXPECT_THROW(static_cast<void>(studentPoint(0.5, 3)), std::invalid_argument);
}

TEST(EquivalenceTest, IsTheLesserOfTwoOneSidedTests) {
  // Mean 10.1, standard error 0.1, one degree of freedom; margin 0.5: 4 standard errors to the nearer limit.
  const Moments values = momentsOf(std::vector<double>{10.0, 10.2});
  const Equivalence found = equivalenceTest(values, 10, 0.05);
  EXPECT_NEAR(found.ratio, 1.01, 1e-12);
  EXPECT_NEAR(found.standardError, 0.01, 1e-12);
  EXPECT_NEAR(found.pValue, 0.5 - std::atan(4.0) / 3.14159265358979, 1e-9);  // Cauchy's distribution
  EXPECT_GT(equivalenceTest(values, 12, 0.05).pValue, 0.5) << "outside of the margin";
}

TEST(EquivalenceTest, ComparesExactlyWithoutAnError) {
  const Moments values = momentsOf(std::vector<double>{3, 3});
  EXPECT_EQ(equivalenceTest(values, 3.1, 0.05).pValue, 0.0);
  EXPECT_EQ(equivalenceTest(values, 3.3, 0.05).pValue, 1.0);
  EXPECT_EQ(equivalenceTest(values, values, 0.05).power(0.01), 1.0);
}

TEST(EquivalenceTest, RefusesWhatItCannotCompare) {
  const Moments one = momentsOf(std::vector<double>{1}), two = momentsOf(std::vector<double>{1, 2}),
                none = momentsOf(std::vector<double>{-1, 1});
  EXPECT_THROW(static_cast<void>(equivalenceTest(one, 1, 0.1)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(equivalenceTest(two, one, 0.1)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(equivalenceTest(two, none, 0.1)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(equivalenceTest(two, 1, 0)), std::invalid_argument);
}

/// Share of 4000 tries in which the test passes at 0.05 for means of the ratio `ratio`, and what power says of the true
/// standard error: 0.02, of 6 values against 10.
double passingShare(double ratio, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  constexpr int kRuns = 4000;
  int passed = 0;
  for (int run = 0; run < kRuns; ++run) {
    const Moments a = normalSample(generator, 6, ratio, 0.0346), b = normalSample(generator, 10, 1, 0.0447);
    passed += equivalenceTest(a, b, 0.07).pValue <= 0.05;
  }
  return static_cast<double>(passed) / kRuns;
}

TEST(EquivalenceTest, PassesMeansThatAreOffByTheMarginNoMoreOftenThanItsSignificanceSays) {
  const double fiveDeviations = 5 * std::sqrt(0.05 * 0.95 / 4000);
  EXPECT_LT(passingShare(1.07, 1), 0.05 + fiveDeviations);
  EXPECT_LT(passingShare(0.93, 2), 0.05 + fiveDeviations);
  EXPECT_GT(passingShare(1.07, 1), 0.02) << "nor much less often";
}

TEST(EquivalenceTest, PassesEqualMeansAsOftenAsItsPowerSays) {
  Equivalence known;
  known.standardError = std::sqrt(0.0346 * 0.0346 / 6 + 1.07 * 1.07 * 0.0447 * 0.0447 / 10);
  known.degreesOfFreedom = 12;
  known.margin = 0.07;
  const double power = known.power(0.05);
  EXPECT_GT(power, 0.8);
  EXPECT_LT(power, 0.95);
  EXPECT_NEAR(passingShare(1, 3), power, 0.03);
}

TEST(Claims, FailWhereTheSamplesAreTooFewToShowThem) {
  const Moments rough = momentsOf(std::vector<double>{0.98, 1.02, 1.0}),
                fine = momentsOf(std::vector<double>{0.998, 1.002, 1.0, 1.001, 0.999, 1.0});
  const ::testing::AssertionResult found = isWithin(0.02, rough, 1);
  EXPECT_FALSE(found);
  EXPECT_NE(std::string(found.message()).find("underpowered"), std::string::npos);
  EXPECT_TRUE(isWithin(0.02, fine, 1));
  EXPECT_TRUE(areWithin(0.02, fine, fine));
  EXPECT_FALSE(isWithin(0.02, fine, 1.03));
  EXPECT_FALSE(isWithin(0.02, fine, 0.97));
}

TEST(Claims, OfBoundsFailWhereAMeanIsOnlyNotRefuted) {
  const Moments values = momentsOf(std::vector<double>{7.9, 8.3, 8.2, 7.7});
  EXPECT_FALSE(isAbove(8, values)) << "8.025 +- 0.14";
  EXPECT_FALSE(isBelow(8, values));
  EXPECT_TRUE(isAbove(7, values));
  EXPECT_TRUE(isBelow(9, values));
  EXPECT_FALSE(isAbove(9, values));
}

TEST(Sidak, KeepsTheSignificanceOfTheWhole) {
  for (const std::int64_t tests : {1, 7, 1000, 1000000}) {
    const double each = sidak(0.01, tests);
    EXPECT_NEAR(1.0 - std::pow(1.0 - each, static_cast<double>(tests)), 0.01, 1e-9) << tests;
  }
}

}  // namespace
}  // namespace importon::test
