/// How far an image is from a reference.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "io/image.h"

namespace importon {

/// Over channels R, G, B. I: the image, R: the reference, N: pixels; means are over pixels and channels.
/// A pixel with a value that isn't finite, in either image, has infinite error in relMSE and RMSE and the
/// greatest one, 1, in SMAPE and FLIP; means leave it out.
struct Comparison {
  double relmse = 0;         // mean of (I-R)²/(R² + floor)
  double relmseTrimmed = 0;  // the same without the N/1000 pixels (rounded down) of greatest error
  double smape = 0;          // mean of |I-R|/(|I|+|R|), 0 where both are 0
  double rmse = 0;           // root of the mean of (I-R)²
  double meanRatio = 0;      // mean of I over mean of R; 1 if both are 0
  double flip = 0;           // mean LDR-FLIP of both images, tone-mapped with the exposure of the reference
  std::uint64_t nonFinitePixels = 0;
};

/// `floor` is the absolute one in the denominator of relMSE, by default 0.01·mean(R)². The names tell where an
/// error lies: SceneError when the sizes differ, or one of R, G, B is missing.
[[nodiscard]] Comparison compareImages(const Image& image, const std::string& imageName, const Image& reference,
                                       const std::string& referenceName, std::optional<double> floor = {});

}  // namespace importon
