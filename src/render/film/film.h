/// The image as sums over passes: emitted and direct, caustic, and indirect light with its modulation apart, each
/// in two halves (even and odd passes).
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/large_vector.h"
#include "gpu/buffer.h"
#include "render/film/adaptive_sampler.h"
#include "shared/render_data.h"

namespace importon {

/// The pixels that are rendered at once: `first` .. `first + count` of the image in row-major order.
struct FilmTile {
  uint first = 0, count = 0;
  gpu::Buffer pixels;  // FilmPixel of the even passes, then of the odd ones
  gpu::Buffer plan{};  // of the paths of the pass at hand; empty: all pixels have as many
};

class Film {
 public:
  /// Tiles of at most `tilePixels` pixels.
  Film(gpu::Context& context, std::uint64_t pixels, std::uint64_t tilePixels);
  [[nodiscard]] std::span<const FilmTile> tiles() const { return tiles_; }
  [[nodiscard]] std::span<FilmTile> tiles() { return tiles_; }
  /// Reads the whole film back: even half, odd half, `pixels` each.
  [[nodiscard]] LargeVector<FilmPixel> download() const;

 private:
  std::uint64_t pixels_;
  std::vector<FilmTile> tiles_;
};

/// Means of the film over paths, per pixel, W/(m² sr); those of the two halves weighted by the paths of the whole
/// image.
struct FilmLayers {
  std::vector<vec3> total, direct, caustic, indirect;
  std::vector<vec3> variance;   // of the mean, from the spread over passes, before any filter
  std::vector<vec3> error;      // standard error expected: render/film/error_estimate.h; 0 if there is no second half
  std::vector<float> coverage;  // share of paths that saw a surface; 1 throughout if the environment is the background
  double estimatedError = 0;    // relative, the same of the whole image
};

/// How to read a film.
struct FilmReading {
  int width = 1;
  SampleCounts counts;
  bool sharesLight = false;  // shares light among pixels: render/filter/light_filter.h
  int threads = 0;
};

/// `halves` as Film::download gives them.
[[nodiscard]] FilmLayers resolveFilm(std::span<const FilmPixel> halves, const FilmReading& reading);

}  // namespace importon
