/// The error of an image, estimated from two halves of its passes.
#pragma once
#include <span>
#include <vector>

#include "shared/render_data.h"

namespace importon {

/// The true error lies between these factors of the estimate in about 90 % of renders: tests/calibration measures it.
inline constexpr double kBandLow = 0.8, kBandHigh = 1.45;

/// Means of the even and of the odd passes per pixel, row-major from the top: independent images of one thing.
struct HalfImages {
  std::span<const vec3> even, odd;
  float evenShare = 0.5f;  // of the even passes in the image
};

struct ErrorEstimate {
  double noise = 0;            // relative: root of the trimmed relMSE that the difference of the halves lets expect
  double bias = 0;             // the same for what sharing light among pixels moved
  double relative = 0;         // of both
  std::vector<vec3> perPixel;  // W/(m² sr): both, over a window around each pixel
};

/// `shown` are the halves with indirect light shared among pixels, `raw` without; the image is the mean of
/// shown.even and shown.odd, the former with share w. With A, B the shown halves and a, b the raw ones, the noise is
/// the root of the mean of w(1-w)(A-B)² / (I² + 0.01 mean(I)²) over pixels and channels without the worst thousandth
/// of the pixels. A-a and B-b have the bias in common and nothing else, so the mean of their product is the squared
/// bias; the differences are averaged over blocks of pixels first, since bias is smooth and noise is not.
[[nodiscard]] ErrorEstimate estimateErrors(const HalfImages& shown, const HalfImages& raw, int width);

}  // namespace importon
