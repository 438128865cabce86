/// Errors as colours.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "io/png.h"

namespace importon {

/// From black (0) over violet, red and orange to pale yellow (1): lightness rises all along, so that it reads in
/// grey too. What is below 0 is black, above 1 or not a number pale yellow. 8-bit sRGB.
[[nodiscard]] std::array<std::uint8_t, 3> falseColor(float value);

/// The picture of `values`, one per pixel.
[[nodiscard]] PngPixels falseColors(int width, int height, std::span<const float> values);

}  // namespace importon
