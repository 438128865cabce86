/// The film on the host, of one device or of several.
#pragma once
#include <cstdint>
#include <vector>

#include "base/large_vector.h"
#include "render/plan/sample_counts.h"
#include "shared/render_data.h"

namespace importon {

/// Sums over paths, and how many paths they are.
struct FilmSums {
  LargeVector<FilmPixel> halves;                  // even half, odd half, as Film::download gives them
  std::uint64_t evenSamples = 0, oddSamples = 0;  // per pixel in the mean over the image
  std::vector<std::int32_t> evenExtra, oddExtra;  // by pixel, beyond these; empty: none
  std::uint64_t passes = 0;
  std::vector<std::uint32_t> seeds;  // of the passes

  [[nodiscard]] SampleCounts counts() const { return {evenSamples, oddSamples, evenExtra, oddExtra}; }

  /// The even half becomes the odd one.
  void swapHalves();
  /// Adds paths of other passes of the same image, half to half.
  void add(const FilmSums& other, int threads);
};

}  // namespace importon
