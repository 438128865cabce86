#include "report/error_statistics.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

#include "base/trimmed_mean.h"
#include "io/tone_map.h"

namespace importon {
namespace {

/// Two-sided 95 % quantile of Student's t.
double studentQuantile(std::size_t degreesOfFreedom) {
  return boost::math::quantile(boost::math::students_t(static_cast<double>(degreesOfFreedom)), 0.975);
}

/// Sum over the pixels of `value` without the thousandth with the greatest `error`, over their number.
double keptMean(const std::vector<double>& value, const std::vector<std::size_t>& kept) {
  double sum = 0;
  for (const std::size_t i : kept) sum += value[i];
  return sum / static_cast<double>(kept.size());
}

/// All but the thousandth of greatest error.
std::vector<std::size_t> keptPixels(const std::vector<double>& errors) {
  std::vector<std::size_t> order(errors.size());
  std::iota(order.begin(), order.end(), 0u);
  const std::size_t kept = keptWhenTrimmed(errors.size());
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept - 1), order.end(),
                   [&](std::size_t a, std::size_t b) { return errors[a] < errors[b]; });
  order.resize(kept);
  return order;
}

}  // namespace

Interval intervalOf(std::span<const double> samples) {
  Interval interval;
  const auto count = static_cast<double>(samples.size());
  interval.mean = std::accumulate(samples.begin(), samples.end(), 0.0) / count;
  if (samples.size() < 2) return interval;
  double squares = 0;
  for (const double sample : samples) squares += (sample - interval.mean) * (sample - interval.mean);
  const double half = studentQuantile(samples.size() - 1) * std::sqrt(squares / (count - 1) / count);
  interval.low = interval.mean - half;
  interval.high = interval.mean + half;
  return interval;
}

Interval logIntervalOf(std::span<const double> samples) {
  std::vector<double> logs;
  for (const double sample : samples) logs.push_back(std::log(sample));
  Interval interval = intervalOf(logs);
  interval.mean = std::exp(interval.mean);
  if (interval.low) interval.low = std::exp(*interval.low);
  if (interval.high) interval.high = std::exp(*interval.high);
  return interval;
}

void ErrorSplit::add(const Image& image) {
  const auto rgb = rgbOf(image, "the image");
  const std::size_t pixels = rgb[0].size();
  sums_.resize(3 * pixels);
  squares_.resize(3 * pixels);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < pixels; ++i) {
      const auto value = static_cast<double>(rgb[c][i]);
      sums_[c * pixels + i] += value;
      squares_[c * pixels + i] += value * value;
    }
  }
  ++seeds_;
}

std::optional<ErrorParts> ErrorSplit::parts(const Image& reference) const {
  if (seeds_ < 2) return {};
  const auto truth = rgbOf(reference, "the reference");
  const std::size_t pixels = truth[0].size();
  const double n = seeds_;
  double mean = 0;
  for (const auto& plane : truth) {
    for (const float value : plane) mean += static_cast<double>(value) / static_cast<double>(3 * pixels);
  }
  std::vector<double> bias(pixels), variance(pixels), error(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto r = static_cast<double>(truth[c][i]);
      const double share = 1 / (3 * std::max(r * r + 0.01 * mean * mean, 1e-300));
      const double average = sums_[c * pixels + i] / n;
      const double spread = std::max(squares_[c * pixels + i] / n - average * average, 0.0) * n / (n - 1);
      bias[i] += share * ((average - r) * (average - r) - spread / n);
      variance[i] += share * spread;
    }
    error[i] = bias[i] + variance[i];
  }
  const std::vector<std::size_t> kept = keptPixels(error);
  return ErrorParts{keptMean(bias, kept), keptMean(variance, kept)};
}

std::optional<double> crossing(std::span<const CurvePoint> curve, double level) {
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (!(curve[i].error <= level)) continue;
    if (i == 0) return curve[0].x;
    const CurvePoint &a = curve[i - 1], &b = curve[i];
    if (b.error <= 0) return b.x;
    const double share = std::log(a.error / level) / std::log(a.error / b.error);
    return a.x * std::pow(b.x / a.x, share);
  }
  return {};
}

}  // namespace importon
