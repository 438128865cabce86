/// How many paths the film holds.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace importon {

/// Paths that went through pixels, in each half of the film (even and odd passes).
struct SampleCounts {
  std::uint64_t evenSamples = 0, oddSamples = 0;      // per pixel in the mean over the image
  std::span<const std::int32_t> evenExtra, oddExtra;  // by pixel, beyond these; empty: none

  /// Of the even half in the image.
  [[nodiscard]] float evenShare() const {
    return static_cast<float>(static_cast<double>(evenSamples) /
                              static_cast<double>(std::max<std::uint64_t>(evenSamples + oddSamples, 1)));
  }
  [[nodiscard]] float even(std::size_t pixel) const { return of(evenSamples, evenExtra, pixel); }
  [[nodiscard]] float odd(std::size_t pixel) const { return of(oddSamples, oddExtra, pixel); }

 private:
  static float of(std::uint64_t samples, std::span<const std::int32_t> extra, std::size_t pixel) {
    return static_cast<float>(static_cast<std::int64_t>(samples) + (extra.empty() ? 0 : extra[pixel]));
  }
};

}  // namespace importon
