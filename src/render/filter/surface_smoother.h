/// Smoothing over neighbouring pixels that see the same surface.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "render/filter/halves.h"
#include "render/plan/sample_counts.h"
#include "shared/render_data.h"

namespace importon {

/// What a pixel sees. Surfaces: its gathers lie on one, and share with those on like surfaces. Glass: the camera sees
/// one surface, beyond which paths go different ways; shares with like glass. Edges: several surfaces; they share with
/// edges that see such a mixture. Pixels without gathers share with none.
enum class PixelKind : std::uint8_t { none, surface, glass, edge };

/// What tells pixels apart: means over their gathers, or, of glass, over what the camera sees.
struct SurfaceGuides {
  int width, height;
  Planes position;  // m
  Planes normal;    // of unit length but on edges
  Planes plane;     // geometric normal if it is known
  std::vector<PixelKind> kind;

  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  /// Whether light on p may stand for that on q: like normals, and each in the other's plane up to a tenth of the
  /// distance.
  [[nodiscard]] bool areAlike(std::size_t p, std::size_t q) const;
};

/// `halves`: the even passes' pixels, then the odd ones'.
[[nodiscard]] SurfaceGuides readGuides(std::span<const FilmPixel> halves, int width, const SampleCounts& counts,
                                       int threads);

/// Means over 5 x 5 pixels that are 2^level apart, by the weights of a cubic B-spline, of those alike: "à trous". One
/// level after the other they come to a Gaussian whose variance is (4^(level + 1) - 1) / 3 pixels. [Dammertz et al.
/// 2010]
class SurfaceSmoother {
 public:
  /// For levels from 0 to `levels` - 1. `guides` stays where it is.
  SurfaceSmoother(const SurfaceGuides& guides, int levels, int threads);
  /// Smooths each plane in its place.
  void smooth(std::span<Plane* const> planes, int level);
  /// Whether no pixel up to two away in its row or column is like it.
  [[nodiscard]] bool isAlone(std::size_t pixel) const { return alike_[0][pixel] == 0; }
  /// About how many independent numbers the mean over three levels from `level` on holds, if each is a detail that
  /// `level` takes away.
  [[nodiscard]] float independentIn(std::size_t pixel, int level) const;
  [[nodiscard]] const SurfaceGuides& guides() const { return guides_; }
  [[nodiscard]] int threads() const { return threads_; }

 private:
  void smoothAlong(bool isX, std::span<Plane* const> planes, int level);

  const SurfaceGuides& guides_;
  int threads_;
  std::vector<std::vector<std::uint8_t>>
      alike_;  // by level and pixel: bits of the neighbours at -2, -1, 1, 2 steps, y's above x's
  std::vector<Plane> spare_;
};

}  // namespace importon
