#include "report/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/trimmed_mean.h"
#include "fmt/format.h"
#include "io/tone_map.h"
#include "report/flip.h"
#include "report/hdr_flip.h"

namespace importon {
namespace {

using Rgb = std::array<std::span<const float>, 3>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool isFinite(const Rgb& rgb, std::size_t pixel) {
  return std::all_of(rgb.begin(), rgb.end(), [&](const auto& plane) { return std::isfinite(plane[pixel]); });
}

/// Mean over the channels of the pixels with `isCounted`; 0 if there are none.
double meanOf(const Rgb& rgb, const std::vector<bool>& isCounted) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < isCounted.size(); ++i) {
    if (!isCounted[i]) continue;
    for (const auto& plane : rgb) sum += static_cast<double>(plane[i]);
    count += 3;
  }
  return count > 0 ? sum / count : 0;
}

double meanOf(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Numerator over denominator, where nothing over nothing is `ofNothing`.
double ratio(double numerator, double denominator, double ofNothing) {
  return numerator == 0 && denominator == 0 ? ofNothing : numerator / denominator;
}

/// Errors of one pixel, each a mean over the channels.
struct PixelError {
  double relative = 0, squared = 0, symmetric = 0;
};

PixelError pixelError(const Rgb& image, const Rgb& reference, std::size_t pixel, double floor) {
  PixelError error;
  for (std::size_t c = 0; c < 3; ++c) {
    const double i = static_cast<double>(image[c][pixel]), r = static_cast<double>(reference[c][pixel]);
    const double squared = (i - r) * (i - r);
    error.relative += ratio(squared, r * r + floor, 0) / 3;
    error.squared += squared / 3;
    error.symmetric += ratio(std::abs(i - r), std::abs(i) + std::abs(r), 0) / 3;
  }
  return error;
}

void checkSizes(const Image& image, const std::string& imageName, const Image& reference,
                const std::string& referenceName) {
  if (image.width == reference.width && image.height == reference.height) return;
  throw SceneError(fmt::format("the image has {} x {} pixels, the reference {} x {}", image.width, image.height,
                               reference.width, reference.height),
                   imageName + ", " + referenceName, "render both at the same size");
}

}  // namespace

ValueErrors compareValues(const Image& image, const std::string& imageName, const Image& reference,
                          const std::string& referenceName, std::optional<double> floor, std::vector<float>* relative) {
  checkSizes(image, imageName, reference, referenceName);
  const Rgb shown = rgbOf(image, imageName), truth = rgbOf(reference, referenceName);
  const std::size_t pixels = truth[0].size();
  std::vector<bool> hasTruth(pixels), isCounted(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    hasTruth[i] = isFinite(truth, i);
    isCounted[i] = hasTruth[i] && isFinite(shown, i);
  }
  const double meanTruth = meanOf(truth, hasTruth);
  const double usedFloor = floor.value_or(0.01 * meanTruth * meanTruth);

  ValueErrors result;
  double relativeSum = 0, squared = 0, symmetric = 0;
  std::vector<double> relativeErrors(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const PixelError error =
        isCounted[i] ? pixelError(shown, truth, i, usedFloor) : PixelError{kInfinity, kInfinity, 1};
    result.nonFinitePixels += isCounted[i] ? 0 : 1;
    relativeErrors[i] = error.relative;
    relativeSum += error.relative;
    squared += error.squared;
    symmetric += error.symmetric;
  }
  if (relative != nullptr) relative->assign(relativeErrors.begin(), relativeErrors.end());
  const auto count = static_cast<double>(pixels);
  result.relmse = relativeSum / count;
  result.relmseTrimmed = trimmedMean(std::move(relativeErrors));
  result.smape = symmetric / count;
  result.rmse = std::sqrt(squared / count);
  result.meanRatio = ratio(meanOf(shown, isCounted), meanOf(truth, isCounted), 1);
  return result;
}

Comparison compareImages(const Image& image, const std::string& imageName, const Image& reference,
                         const std::string& referenceName, std::optional<double> floor, ErrorMaps* maps) {
  ErrorMaps found;
  Comparison result;
  static_cast<ValueErrors&>(result) = compareValues(image, imageName, reference, referenceName, floor, &found.relative);
  const float exposure = autoExposure(reference, referenceName);
  found.flip = ldrFlipMap(toneMapped(image, exposure, imageName), toneMapped(reference, exposure, referenceName));
  found.flipHdr = hdrFlipMap(image, imageName, reference, referenceName);
  result.flip = meanOf(found.flip);
  result.flipHdr = meanOf(found.flipHdr);
  if (maps != nullptr) *maps = std::move(found);
  return result;
}

Image differenceImage(const Image& image, const std::string& imageName, const Image& reference,
                      const std::string& referenceName, const ErrorMaps& maps) {
  checkSizes(image, imageName, reference, referenceName);
  const Rgb shown = rgbOf(image, imageName), truth = rgbOf(reference, referenceName);
  Image difference{image.width, image.height, {}, {}, image.whole};
  constexpr std::array<const char*, 3> kNames{"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<float> values(truth[c].size());
    std::transform(shown[c].begin(), shown[c].end(), truth[c].begin(), values.begin(), std::minus<>());
    difference.channels.push_back({kNames[c], std::move(values)});
  }
  difference.channels.push_back({"relative.Y", maps.relative});
  difference.channels.push_back({"flip.Y", maps.flip});
  difference.channels.push_back({"flip_hdr.Y", maps.flipHdr});
  return difference;
}

}  // namespace importon
