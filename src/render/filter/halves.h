/// Planes of numbers for each pixel, also in two halves of the passes.
#pragma once
#include <array>
#include <cstddef>
#include <vector>

namespace importon {

using Plane = std::vector<float>;     // row by row from the top
using Planes = std::array<Plane, 3>;  // by channel

inline Planes planesOf(std::size_t pixels) { return {Plane(pixels), Plane(pixels), Plane(pixels)}; }

/// The channels of the even passes, then those of the odd ones.
constexpr std::size_t kEven = 0, kOdd = 3;

/// Irradiance: light over its modulation.
struct Halves {
  std::array<Plane, 6> planes;

  explicit Halves(std::size_t pixels) { planes.fill(Plane(pixels)); }
};

/// How much squared errors count where the channels of both halves come to `sum`: relative to what is there, as in
/// relMSE. `leastSquare`: of such sums, above 0.
inline float importanceOf(float sum, float leastSquare) { return 1 / (sum * sum + leastSquare); }

}  // namespace importon
