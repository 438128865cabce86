/// The image as sums over passes: emitted and direct, caustic, and indirect light with its modulation apart, each
/// in two halves (even and odd passes).
#pragma once
#include <span>
#include <vector>

#include "gpu/buffer.h"
#include "shared/render_data.h"

namespace importon {

/// The pixels that are rendered at once: `first` .. `first + count` of the image in row-major order.
struct FilmTile {
  uint first = 0, count = 0;
  gpu::Buffer pixels;  // FilmPixel of the even passes, then of the odd ones
};

class Film {
 public:
  /// Tiles of at most `tilePixels` pixels.
  Film(gpu::Context& context, std::uint64_t pixels, std::uint64_t tilePixels);
  [[nodiscard]] std::span<const FilmTile> tiles() const { return tiles_; }
  /// Reads the whole film back: even half, odd half, `pixels` each.
  [[nodiscard]] std::vector<FilmPixel> download() const;

 private:
  std::uint64_t pixels_;
  std::vector<FilmTile> tiles_;
};

/// Means of the film over `passes` passes, per pixel, W/(m² sr).
struct FilmLayers {
  std::vector<vec3> total, direct, caustic, indirect;
  std::vector<vec3> variance;  // of the mean, from the spread over passes
};

/// `halves` as Film::download gives them. Passes are dealt to the halves in turn, the even half first.
[[nodiscard]] FilmLayers resolveFilm(std::span<const FilmPixel> halves, int passes);

/// Estimated relative error of the mean from the difference of the halves: the square root of
/// mean((A-B)²/4 / (I² + 0.01 mean(I)²)) without the worst 0.1 % of pixels. Needs an even number of passes.
[[nodiscard]] double estimateError(std::span<const FilmPixel> halves, int passes);

}  // namespace importon
