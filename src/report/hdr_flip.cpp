#include "report/hdr_flip.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/tone_map.h"
#include "report/flip.h"

namespace importon {
namespace {

/// (k0 x² + k1 x)/(k3 x² + k4 x + k5): the ACES fit of Narkowicz for 0.6 x.
struct AcesFit {
  double k0 = 0.6 * 0.6 * 2.51, k1 = 0.6 * 0.03, k3 = 0.6 * 0.6 * 2.43, k4 = 0.6 * 0.59, k5 = 0.14;
};

/// The value that the curve maps to `shown`: the larger root of a quadratic.
double acesInverse(double shown) {
  const AcesFit fit;
  const double a = fit.k0 - shown * fit.k3, b = fit.k1 - shown * fit.k4, c = -shown * fit.k5;
  return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

/// Of sorted values: the middle one, or the mean of the middle two.
double medianOf(std::span<const double> sorted) {
  const std::size_t middle = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
}

std::vector<double> luminancesOf(const Image& image, const std::string& where) {
  const auto rgb = rgbOf(image, where);
  std::vector<double> luminances(rgb[0].size());
  for (std::size_t i = 0; i < luminances.size(); ++i) {
    luminances[i] = 0.2126 * static_cast<double>(rgb[0][i]) + 0.7152 * static_cast<double>(rgb[1][i]) +
                    0.0722 * static_cast<double>(rgb[2][i]);
  }
  return luminances;
}

ShownImage shownAt(const Image& image, double stops, const std::string& where) {
  const auto scale = static_cast<float>(std::exp2(stops));
  const auto rgb = rgbOf(image, where);
  ShownImage shown{image.width, image.height, {}, std::vector<bool>(rgb[0].size())};
  for (std::size_t c = 0; c < 3; ++c) {
    shown.rgb[c].reserve(rgb[c].size());
    for (std::size_t i = 0; i < rgb[c].size(); ++i) {
      const bool isFinite = std::isfinite(rgb[c][i]);
      shown.rgb[c].push_back(isFinite ? acesCurve(scale * rgb[c][i]) : 0);
      shown.isBroken[i] = shown.isBroken[i] || !isFinite;
    }
  }
  return shown;
}

}  // namespace

float acesCurve(float exposed) {
  constexpr float kFar = 1e9F;  // the curve is flat there, and its squares stay finite
  const AcesFit fit;
  const auto x = static_cast<double>(std::clamp(exposed, 0.F, kFar));
  return static_cast<float>(std::clamp((fit.k0 * x + fit.k1) * x / ((fit.k3 * x + fit.k4) * x + fit.k5), 0.0, 1.0));
}

ExposureRange exposureRange(std::span<const double> luminances) {
  constexpr double kLeast = std::numeric_limits<float>::epsilon();  // as the authors bound black images
  std::vector<double> sorted;
  std::copy_if(luminances.begin(), luminances.end(), std::back_inserter(sorted),
               [](double y) { return std::isfinite(y); });
  std::sort(sorted.begin(), sorted.end());
  const double brightest = sorted.empty() ? kLeast : std::max(sorted.back(), kLeast);
  const double median = sorted.empty() ? kLeast : std::max(medianOf(sorted), kLeast);
  const double clipped = acesInverse(0.85);
  ExposureRange range{std::log2(clipped / brightest), std::log2(clipped / median), 2};
  range.count = std::max(2, static_cast<int>(std::ceil(range.stop - range.start)));
  return range;
}

std::vector<float> hdrFlipMap(const Image& test, const std::string& testName, const Image& reference,
                              const std::string& referenceName) {
  const ExposureRange range = exposureRange(luminancesOf(reference, referenceName));
  std::vector<float> greatest;
  for (int i = 0; i < range.count; ++i) {
    const double stops = range.start + (range.stop - range.start) * i / (range.count - 1);
    const std::vector<float> map = ldrFlipMap(shownAt(test, stops, testName), shownAt(reference, stops, referenceName));
    if (greatest.empty()) greatest = map;
    std::transform(greatest.begin(), greatest.end(), map.begin(), greatest.begin(),
                   [](float a, float b) { return std::max(a, b); });
  }
  return greatest;
}

}  // namespace importon
