/// What several seeds tell of the error of a renderer.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "io/image.h"

namespace importon {

/// A value with its 95 % confidence interval; the interval is empty where there are less than two samples.
struct Interval {
  double mean = 0;
  std::optional<double> low, high;
};

/// Student's interval of the mean.
[[nodiscard]] Interval intervalOf(std::span<const double> samples);

/// The same of the logarithms: for times, which spread by factors. Samples are above 0.
[[nodiscard]] Interval logIntervalOf(std::span<const double> samples);

/// relMSE in two parts: of the mean over infinitely many seeds, and of single images around it.
struct ErrorParts {
  double squaredBias = 0, variance = 0;
};

/// Takes the images of one configuration at one moment, one seed after the other.
class ErrorSplit {
 public:
  void add(const Image& image);
  [[nodiscard]] int seeds() const { return seeds_; }
  /// Unbiased estimates from two seeds on, over pixels and channels without the thousandth of the pixels with the
  /// greatest error: their sum is the mean over seeds of (I-R)²/(R² + 0.01·mean(R)²). The squared bias may come out
  /// slightly below 0. Nothing is returned for less than two seeds.
  [[nodiscard]] std::optional<ErrorParts> parts(const Image& reference) const;

 private:
  int seeds_ = 0;
  std::vector<double> sums_, squares_;  // R, then G, then B
};

/// A point of an error curve.
struct CurvePoint {
  double x = 0, error = 0;
};

/// The x at which a curve, points in order of rising x, first falls to `level`, by interpolation of logarithms.
/// Before the first point: that point's x. Empty: it is never reached.
[[nodiscard]] std::optional<double> crossing(std::span<const CurvePoint> curve, double level);

}  // namespace importon
