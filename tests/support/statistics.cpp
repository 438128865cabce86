#include "support/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "support/special_functions.h"

namespace importon::test {
namespace {

struct Cell {
  double observed = 0;
  double expected = 0;
};

void requireComparable(std::span<const double> observed, std::span<const double> expected) {
  if (observed.size() != expected.size() || observed.empty()) {
    throw std::invalid_argument("chiSquareTest: needs as many expectations as counts, and one at least");
  }
  for (const double e : expected) {
    if (!(e >= 0) || !std::isfinite(e)) {
      throw std::invalid_argument("chiSquareTest: an expectation is negative or not finite");
    }
  }
  const double counted = std::accumulate(observed.begin(), observed.end(), 0.0);
  const double total = std::accumulate(expected.begin(), expected.end(), 0.0);
  if (std::abs(counted - total) > 1e-6 * std::max(counted, total)) {
    throw std::invalid_argument("chiSquareTest: the totals differ");
  }
}

/// Joins the cells that expect least until each expects `leastExpected`; a rest that doesn't joins the last.
std::vector<Cell> pool(std::vector<Cell> cells, double leastExpected) {
  std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.expected < b.expected; });
  std::vector<Cell> pooled;
  Cell open;
  for (const Cell& cell : cells) {
    open.observed += cell.observed;
    open.expected += cell.expected;
    if (open.expected < leastExpected) continue;
    pooled.push_back(open);
    open = {};
  }
  if (pooled.empty()) return {open};
  pooled.back().observed += open.observed;
  pooled.back().expected += open.expected;
  return pooled;
}

double twoSidedNormal(double z) { return std::erfc(std::abs(z) / std::numbers::sqrt2); }

/// P(|T| >= |t|) of Student's distribution [DLMF 8.17; Abramowitz and Stegun 26.7.1].
double twoSidedStudent(double t, double degreesOfFreedom) {
  return regularizedBeta(0.5 * degreesOfFreedom, 0.5, degreesOfFreedom / (degreesOfFreedom + t * t));
}

TestResult exactComparison(bool isEqual) {
  return isEqual ? TestResult{0, 0, 1} : TestResult{std::numeric_limits<double>::infinity(), 0, 0};
}

void requireTwo(const Moments& values) {
  if (values.count() < 2) throw std::invalid_argument("a t-test needs two values at least");
}

}  // namespace

void Moments::add(double value) {
  ++count_;
  const double fromOldMean = value - mean_;
  mean_ += fromOldMean / static_cast<double>(count_);
  squares_ += fromOldMean * (value - mean_);
}

void Moments::merge(const Moments& other) {
  if (other.count_ == 0) return;
  const auto n = static_cast<double>(count_);
  const auto m = static_cast<double>(other.count_);
  const double apart = other.mean_ - mean_;
  mean_ += apart * m / (n + m);
  squares_ += other.squares_ + apart * apart * n * m / (n + m);
  count_ += other.count_;
}

double Moments::variance() const { return count_ < 2 ? 0.0 : squares_ / static_cast<double>(count_ - 1); }

double Moments::standardError() const {
  return count_ == 0 ? 0.0 : std::sqrt(variance() / static_cast<double>(count_));
}

Moments momentsOf(std::span<const double> values) {
  Moments moments;
  for (const double value : values) moments.add(value);
  return moments;
}

Moments momentsOf(std::span<const float> values) {
  Moments moments;
  for (const float value : values) moments.add(static_cast<double>(value));
  return moments;
}

TestResult chiSquareTest(std::span<const double> observed, std::span<const double> expected,
                         int fittedParameters, double leastExpected) {
  requireComparable(observed, expected);
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (expected[i] == 0 && observed[i] > 0) return exactComparison(false);
    if (expected[i] > 0) cells.push_back({observed[i], expected[i]});
  }
  const std::vector<Cell> pooled = pool(std::move(cells), leastExpected);
  TestResult result;
  for (const Cell& cell : pooled) {
    if (cell.expected > 0) {
      result.statistic += (cell.observed - cell.expected) * (cell.observed - cell.expected) / cell.expected;
    }
  }
  result.degreesOfFreedom = static_cast<double>(pooled.size()) - 1.0 - fittedParameters;
  if (result.degreesOfFreedom >= 1) {
    result.pValue = regularizedGammaQ(0.5 * result.degreesOfFreedom, 0.5 * result.statistic);
  }
  return result;
}

TestResult zTest(double value, double standardError, double expected) {
  if (standardError == 0) return exactComparison(value == expected);
  const double z = (value - expected) / standardError;
  return {z, 0, twoSidedNormal(z)};
}

TestResult zTest(double valueA, double standardErrorA, double valueB, double standardErrorB) {
  return zTest(valueA, std::hypot(standardErrorA, standardErrorB), valueB);
}

TestResult tTest(const Moments& values, double expected) {
  requireTwo(values);
  if (values.variance() == 0) return exactComparison(values.mean() == expected);
  const double t = (values.mean() - expected) / values.standardError();
  const auto degreesOfFreedom = static_cast<double>(values.count() - 1);
  return {t, degreesOfFreedom, twoSidedStudent(t, degreesOfFreedom)};
}

TestResult welchTest(const Moments& a, const Moments& b) {
  requireTwo(a);
  requireTwo(b);
  const double va = a.variance() / static_cast<double>(a.count());
  const double vb = b.variance() / static_cast<double>(b.count());
  if (va + vb == 0) return exactComparison(a.mean() == b.mean());
  const double t = (a.mean() - b.mean()) / std::sqrt(va + vb);
  // [Welch 1947, Satterthwaite 1946]
  const double degreesOfFreedom =
      (va + vb) * (va + vb) /
      (va * va / static_cast<double>(a.count() - 1) + vb * vb / static_cast<double>(b.count() - 1));
  return {t, degreesOfFreedom, twoSidedStudent(t, degreesOfFreedom)};
}

double sidak(double significance, std::int64_t tests) {
  return -std::expm1(std::log1p(-significance) / static_cast<double>(tests));
}

}  // namespace importon::test
