/// Statistical tests with stated significance, for tests that sample. A p-value is the probability of a result
/// at least this far off if the hypothesis holds; a test fails when it is below the significance (see sidak).
#pragma once
#include <cstdint>
#include <span>

namespace importon::test {

/// Mean and variance of a stream of values [Welford 1962].
class Moments {
 public:
  void add(double value);
  /// As if the values of `other` had been added [Chan et al. 1979].
  void merge(const Moments& other);
  [[nodiscard]] std::int64_t count() const { return count_; }
  [[nodiscard]] double mean() const { return mean_; }
  /// Of one value, unbiased; 0 for less than two values.
  [[nodiscard]] double variance() const;
  /// Standard deviation of the mean.
  [[nodiscard]] double standardError() const;

 private:
  std::int64_t count_ = 0;
  double mean_ = 0;
  double squares_ = 0;  // sum of squared deviations from the mean
};

[[nodiscard]] Moments momentsOf(std::span<const double> values);
[[nodiscard]] Moments momentsOf(std::span<const float> values);

/// Of each a[i] / b[i], for pairs whose noise is much alike, as that of renders with the same seed.
[[nodiscard]] Moments ratiosOf(std::span<const double> a, std::span<const double> b);

struct TestResult {
  double statistic = 0;
  double degreesOfFreedom = 0;  // 0 for a z-test
  double pValue = 1;            // two-sided for z and t
};

/// Pearson's chi-square test of counts against expected counts. Cells that expect less than `leastExpected` are
/// pooled, the smallest first. Any count where nothing is expected gives p = 0. `fittedParameters` are taken
/// off the degrees of freedom, beside the one for the total. Throws std::invalid_argument if the sizes differ,
/// an expectation is negative or not finite, or the totals differ by more than 1e-6 relative.
[[nodiscard]] TestResult chiSquareTest(std::span<const double> observed, std::span<const double> expected,
                                       int fittedParameters = 0, double leastExpected = 5);

/// That a value with this standard error has the mean `expected`. With a standard error of 0: p = 1 if equal,
/// else 0.
[[nodiscard]] TestResult zTest(double value, double standardError, double expected);

/// That two independent estimates have the same mean.
[[nodiscard]] TestResult zTest(double valueA, double standardErrorA, double valueB, double standardErrorB);

/// Student's test that the values have the mean `expected`. Needs two values, else throws
/// std::invalid_argument.
[[nodiscard]] TestResult tTest(const Moments& values, double expected);

/// Welch's test that two samples have the same mean, whatever their variances. Needs two values in each.
[[nodiscard]] TestResult welchTest(const Moments& a, const Moments& b);

/// How surely means are equal within a relative margin, by two one-sided t-tests: that the ratio is above 1 - margin,
/// and that it is below 1 + margin. [Schuirmann 1987]
struct Equivalence {
  double ratio = 0;          // of the mean found to the one expected
  double standardError = 0;  // of the ratio
  double degreesOfFreedom = 0;
  double margin = 0;
  double pValue = 1;  // the greater one: probability of a result that speaks so well for equality if the ratio is off
                      // by the margin
  /// Probability that a test with this standard error gives a p-value of at most `significance` if the ratio is 1.
  [[nodiscard]] double power(double significance) const;
};

/// That the values have the mean `expected` within `margin` of it. Needs two values, an expectation that is not 0 and a
/// margin in (0, 1), else throws std::invalid_argument.
[[nodiscard]] Equivalence equivalenceTest(const Moments& values, double expected, double margin);

/// That the mean of a is that of b within `margin` of it, whatever their variances [Welch 1947].
[[nodiscard]] Equivalence equivalenceTest(const Moments& a, const Moments& b, double margin);

/// The t that Student's distribution exceeds with the probability `significance`, which is in (0, 0.5).
[[nodiscard]] double studentPoint(double significance, double degreesOfFreedom);

/// The probability that a chi-square distributed value is beyond `statistic`.
[[nodiscard]] double chiSquareBeyond(double statistic, double degreesOfFreedom);

/// Significance of each of `tests` independent tests such that all hold with probability 1 - significance
/// [Šidák 1967].
[[nodiscard]] double sidak(double significance, std::int64_t tests);

}  // namespace importon::test
