#include "report/error_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "report/sample_report.h"

namespace importon {
namespace {

using test::greyRow;

// Student's 97.5 % quantile in closed form, for one degree of freedom (Cauchy's distribution) and for two.
const double kOne = std::tan(0.475 * M_PI), kTwo = 0.95 * std::sqrt(2 / (4 * 0.975 * 0.025));

// 1, 2, 3: mean 2, standard error 1/sqrt(3).
TEST(Interval, IsStudents) {
  const Interval interval = intervalOf(std::vector<double>{1, 2, 3});
  EXPECT_NEAR(interval.mean, 2, 1e-12);
  EXPECT_NEAR(*interval.low, 2 - kTwo / std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(*interval.high, 2 + kTwo / std::sqrt(3.0), 1e-9);
}

TEST(Interval, IsUnknownForOneSample) {
  const Interval interval = intervalOf(std::vector<double>{5});
  EXPECT_EQ(interval.mean, 5);
  EXPECT_FALSE(interval.low);
  EXPECT_FALSE(interval.high);
}

// 1 and 4: logarithms 0 and 2 log 2, standard error log 2.
TEST(Interval, OfLogarithmsSpreadsByFactors) {
  const Interval interval = logIntervalOf(std::vector<double>{1, 4});
  EXPECT_NEAR(interval.mean, 2, 1e-12);
  EXPECT_NEAR(*interval.high / 2, std::pow(2, kOne), 1e-6 * std::pow(2, kOne));
  EXPECT_NEAR(*interval.low * *interval.high, 4, 1e-9);
}

// Of 2000 intervals of four normal samples 95 % hold the mean: a binomial count, standard deviation 9.75; outside
// five of them with probability 6e-7.
TEST(Interval, HoldsTheMeanAsOftenAsItSays) {
  std::mt19937 generator(1);
  std::normal_distribution<double> normal(3, 2);
  int held = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<double> samples;
    for (int k = 0; k < 4; ++k) samples.push_back(normal(generator));
    const Interval interval = intervalOf(samples);
    held += *interval.low <= 3 && 3 <= *interval.high ? 1 : 0;
  }
  EXPECT_NEAR(held, 1900, 5 * 9.75);
}

// R = 1, floor 0.01; images 1.5 and 2.5: mean 2, variance 0.5. Squared bias (1 - 0.5/2)/1.01, variance 0.5/1.01;
// the sum is the mean of 0.25 and 2.25, over 1.01.
TEST(ErrorSplit, HasTheValuesWorkedByHand) {
  ErrorSplit split;
  split.add(greyRow({1.5F}));
  EXPECT_FALSE(split.parts(greyRow({1})));
  split.add(greyRow({2.5F}));
  const auto parts = split.parts(greyRow({1}));
  ASSERT_TRUE(parts);
  EXPECT_NEAR(parts->squaredBias, 0.75 / 1.01, 1e-9);
  EXPECT_NEAR(parts->variance, 0.5 / 1.01, 1e-9);
  EXPECT_NEAR(parts->squaredBias + parts->variance, (0.25 + 2.25) / 2 / 1.01, 1e-9);
}

TEST(ErrorSplit, LeavesOutTheWorstThousandth) {
  std::vector<float> truth(1000, 1), first(1000, 1), second(1000, 1);
  first[3] = 100;
  ErrorSplit split;
  split.add(greyRow(first));
  split.add(greyRow(second));
  EXPECT_EQ(split.parts(greyRow(truth))->variance, 0);
}

// Normal noise of variance 0.04 around 1.2, where the truth is 1: over 4000 pixels and eight seeds the squared bias
// is 0.04/1.01 with a standard deviation of about 2·0.2·sqrt(0.04/8/4000)/1.01; five of these.
TEST(ErrorSplit, TellsBiasFromNoise) {
  std::mt19937 generator(2);
  std::normal_distribution<float> normal(1.2F, 0.2F);
  const std::vector<float> truth(4000, 1);
  ErrorSplit split;
  for (int seed = 0; seed < 8; ++seed) {
    std::vector<float> values(4000);
    for (float& value : values) value = normal(generator);
    split.add(greyRow(values));
  }
  const auto parts = split.parts(greyRow(truth));
  EXPECT_NEAR(parts->squaredBias, 0.04 / 1.01, 5 * 2 * 0.2 * std::sqrt(0.04 / 8 / 4000) + 0.001);
  EXPECT_NEAR(parts->variance, 0.04 / 1.01, 5 * 0.04 * std::sqrt(2.0 / 7 / 4000) + 0.001);
}

// From (1, 0.16) to (2, 0.04) in logarithms: 0.08 at sqrt(2).
TEST(Crossing, InterpolatesLogarithms) {
  const std::vector<CurvePoint> curve{{1, 0.16}, {2, 0.04}, {4, 0.01}};
  EXPECT_NEAR(*crossing(curve, 0.08), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(*crossing(curve, 0.01), 4, 1e-12);
  EXPECT_EQ(*crossing(curve, 0.5), 1);
  EXPECT_FALSE(crossing(curve, 0.009));
  EXPECT_FALSE(crossing({}, 1));
}

}  // namespace
}  // namespace importon
