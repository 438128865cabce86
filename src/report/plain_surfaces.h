/// What the eye finds on plain surfaces where an image is not clean: blotches against a reference, and grain without
/// one.
#pragma once
#include <cstdint>
#include <vector>

#include "io/image.h"

namespace importon {

/// Pixels around which, two pixels wide, there is one flat surface (layers N and P) without an edge of direct light
/// (layer direct, where it is). All pixels if `layers` has no N and P, each with channels X, Y, Z.
struct PlainSurfaces {
  std::vector<bool> isPlain;  // by pixel
  bool isKnown = false;       // the image had the layers
};
/// `color` has the channels R, G, B of an image of the same size, which may be the same.
[[nodiscard]] PlainSurfaces findPlainSurfaces(const Image& layers, const Image& color);

/// As the reference shows them, if it has the layers, else as the image does. Both with their layers, and in colour.
[[nodiscard]] PlainSurfaces findPlainSurfaces(const Image& wholeReference, const Image& reference, const Image& whole,
                                              const Image& image);

/// The part of ln(I/R) between Gaussians of 2 and of 8 pixels (standard deviations), luminances, on plain surfaces:
/// what is larger than grain and smaller than the picture's own light.
struct BandError {
  double rms = 0, p95 = 0, p99 = 0;  // of its magnitude; 0.01 is a per cent
  std::uint64_t pixels = 0;          // it was measured on
};

/// Sizes are those of the images, which have the channels R, G, B. Pixels that are not finite and positive in both are
/// left out.
[[nodiscard]] BandError bandError(const Image& image, const Image& reference, const PlainSurfaces& plain);

/// How uneven the grain of an image is: the standard deviation over 5 x 5 pixels of ln I minus its mean over 3 x 3, at
/// its 99.5th percentile over its 25th, on plain surfaces. White noise has 1.6, single spots on a smooth wall ten or
/// more. 0 where there is no grain at all.
[[nodiscard]] double grainRatio(const Image& image, const PlainSurfaces& plain);

}  // namespace importon
