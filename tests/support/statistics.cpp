#include "support/statistics.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <vector>

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

/// P(T >= t) of Student's distribution.
double upperStudent(double t, double degreesOfFreedom) {
  return boost::math::cdf(boost::math::complement(boost::math::students_t(degreesOfFreedom), t));
}

double twoSidedStudent(double t, double degreesOfFreedom) { return 2 * upperStudent(std::abs(t), degreesOfFreedom); }

TestResult exactComparison(bool isEqual) {
  return isEqual ? TestResult{0, 0, 1} : TestResult{std::numeric_limits<double>::infinity(), 0, 0};
}

void requireTwo(const Moments& values) {
  if (values.count() < 2) throw std::invalid_argument("a t-test needs two values at least");
}

/// Degrees of freedom of a sum of two means with the variances va and vb [Satterthwaite 1946].
double satterthwaite(double va, std::int64_t countA, double vb, std::int64_t countB) {
  return (va + vb) * (va + vb) /
         (va * va / static_cast<double>(countA - 1) + vb * vb / static_cast<double>(countB - 1));
}

Equivalence equivalenceOf(double ratio, double standardError, double degreesOfFreedom, double margin) {
  Equivalence result{ratio, standardError, degreesOfFreedom, margin, 1};
  const double inside = margin - std::abs(ratio - 1);
  if (standardError == 0) {
    result.pValue = inside > 0 ? 0 : 1;
  } else {
    result.pValue = upperStudent(inside / standardError, degreesOfFreedom);
  }
  return result;
}

void requireEquivalenceTest(double expected, double margin) {
  if (!(margin > 0 && margin < 1) || expected == 0 || !std::isfinite(expected)) {
    throw std::invalid_argument("equivalenceTest: needs a margin between 0 and 1 and an expectation other than 0");
  }
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

Moments ratiosOf(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size()) throw std::invalid_argument("ratiosOf: needs pairs");
  Moments moments;
  for (std::size_t i = 0; i < a.size(); ++i) moments.add(a[i] / b[i]);
  return moments;
}

TestResult chiSquareTest(std::span<const double> observed, std::span<const double> expected, int fittedParameters,
                         double leastExpected) {
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
    result.pValue = chiSquareBeyond(result.statistic, result.degreesOfFreedom);
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
  const double degreesOfFreedom = satterthwaite(va, a.count(), vb, b.count());  // [Welch 1947]
  return {t, degreesOfFreedom, twoSidedStudent(t, degreesOfFreedom)};
}

/// Averaged over the standard errors that such samples may show, whose ratio to the true one has the density of a chi
/// over the root of its degrees of freedom.
double Equivalence::power(double significance) const {
  if (standardError == 0) return 1;
  const double atEquality = margin / standardError, point = studentPoint(significance, degreesOfFreedom);
  constexpr int kSteps = 4000;
  constexpr double kMostError = 5;  // of the true one; a chi of one degree of freedom is rarely above
  double passed = 0, all = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double error = (i + 0.5) * kMostError / kSteps;
    const double density =
        std::exp((degreesOfFreedom - 1) * std::log(error) - 0.5 * degreesOfFreedom * (error * error - 1));
    const double widest = atEquality - point * error;  // of a passing deviation, in true standard errors
    if (widest > 0) passed += density * (1 - twoSidedNormal(widest));
    all += density;
  }
  return passed / all;
}

Equivalence equivalenceTest(const Moments& values, double expected, double margin) {
  requireTwo(values);
  requireEquivalenceTest(expected, margin);
  return equivalenceOf(values.mean() / expected, values.standardError() / std::abs(expected),
                       static_cast<double>(values.count() - 1), margin);
}

Equivalence equivalenceTest(const Moments& a, const Moments& b, double margin) {
  requireTwo(a);
  requireTwo(b);
  requireEquivalenceTest(b.mean(), margin);
  // Of a - (1 ± margin) b; the greater one for both sides.
  const double va = a.variance() / static_cast<double>(a.count());
  const double vb = (1 + margin) * (1 + margin) * b.variance() / static_cast<double>(b.count());
  const double degreesOfFreedom = va + vb == 0 ? 1 : satterthwaite(va, a.count(), vb, b.count());
  return equivalenceOf(a.mean() / b.mean(), std::sqrt(va + vb) / std::abs(b.mean()), degreesOfFreedom, margin);
}

double studentPoint(double significance, double degreesOfFreedom) {
  if (!(significance > 0 && significance < 0.5))
    throw std::invalid_argument("studentPoint: needs 0 < significance < 0.5");
  return boost::math::quantile(boost::math::complement(boost::math::students_t(degreesOfFreedom), significance));
}

double chiSquareBeyond(double statistic, double degreesOfFreedom) {
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(degreesOfFreedom), statistic));
}

double sidak(double significance, std::int64_t tests) {
  return -std::expm1(std::log1p(-significance) / static_cast<double>(tests));
}

}  // namespace importon::test
