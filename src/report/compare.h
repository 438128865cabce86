/// How far an image is from a reference.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/image.h"

namespace importon {

/// Over channels R, G, B. I: the image, R: the reference, N: pixels; means are over pixels and channels.
/// A pixel with a value that isn't finite, in either image, has infinite error in relMSE and RMSE and the
/// greatest one, 1, in SMAPE and FLIP; means leave it out.
struct ValueErrors {
  double relmse = 0;         // mean of (I-R)²/(R² + floor)
  double relmseTrimmed = 0;  // the same without the N/1000 pixels (rounded down) of greatest error
  double smape = 0;          // mean of |I-R|/(|I|+|R|), 0 where both are 0
  double rmse = 0;           // root of the mean of (I-R)²
  double meanRatio = 0;      // mean of I over mean of R; 1 if both are 0
  std::uint64_t nonFinitePixels = 0;
};

/// With what the eye makes of them.
struct Comparison : ValueErrors {
  double flip = 0;     // mean LDR-FLIP of both images, tone-mapped with the exposure of the reference
  double flipHdr = 0;  // mean HDR-FLIP: report/hdr_flip.h
};

/// Where the errors are: one value per pixel, row-major from the top.
struct ErrorMaps {
  std::vector<float> relative;  // (I-R)²/(R² + floor), mean over the channels
  std::vector<float> flip, flipHdr;
};

/// The errors without FLIP, which takes longest; arguments and errors as for compareImages. `relative`, if given,
/// takes ErrorMaps::relative.
[[nodiscard]] ValueErrors compareValues(const Image& image, const std::string& imageName, const Image& reference,
                                        const std::string& referenceName, std::optional<double> floor = {},
                                        std::vector<float>* relative = nullptr);

/// `floor` is the absolute one in the denominator of relMSE, by default 0.01·mean(R)². The names tell where an
/// error lies: SceneError when the sizes differ, or one of R, G, B is missing. `maps`, if given, takes
/// the errors per pixel.
[[nodiscard]] Comparison compareImages(const Image& image, const std::string& imageName, const Image& reference,
                                       const std::string& referenceName, std::optional<double> floor = {},
                                       ErrorMaps* maps = nullptr);

/// What `--diff` writes: I-R as R, G, B, and the layers relative.Y, flip.Y and flip_hdr.Y.
[[nodiscard]] Image differenceImage(const Image& image, const std::string& imageName, const Image& reference,
                                    const std::string& referenceName, const ErrorMaps& maps);

}  // namespace importon
