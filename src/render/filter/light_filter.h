/// Shares light among neighbouring pixels that see the same surface.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/filter/half_statistics.h"
#include "render/filter/halves.h"
#include "render/filter/surface_smoother.h"
#include "render/plan/sample_counts.h"
#include "shared/render_data.h"

namespace importon {

/// Light of both halves with its modulation, per pixel: means over paths.
struct LightOfHalves {
  std::vector<vec3> even, odd;
};

inline LightOfHalves darkHalves(std::size_t pixels) { return {std::vector<vec3>(pixels), std::vector<vec3>(pixels)}; }

/// What pixels on edges have: their own light, or that of the surfaces beside them in their shares.
enum class OnEdges { own, mixture };

constexpr int kFilterScales = 6;  // the smoothest is a Gaussian of 37 pixels

/// What light is divided by, and shared with, whichever part of the light it is.
struct LightWeights {
  Planes own;                                // the modulation, mean of both halves, or of glass 1
  std::array<Planes, kFilterScales> smooth;  // after each scale
};

/// What a filter works on: a part of the light.
struct LightAtHand {
  Halves raw, shown, rest;
  Plane importance;       // of squared errors
  float leastSquare = 0;  // of the sum of both halves' channels, that errors count relative to

  explicit LightAtHand(std::size_t pixels) : raw(pixels), shown(pixels), rest(pixels), importance(pixels) {}
};

/// What the halves are: even and odd passes, or, of a film that has only one half, the two colours of a chessboard.
/// Then the light of a pixel is, in each half, the mean over pixels of one colour among it and the eight around it.
enum class HalvesBy { passes, chessboard };

/// A scale of it.
struct ScaleAtHand {
  Halves sums;          // of light times weights, smoothed
  Halves fine, detail;  // what is left to be smoothed, and what this scale takes away from it
  HalfStatistics statistics;
  Plane near;  // share of light in the smaller window

  explicit ScaleAtHand(std::size_t pixels)
      : sums(pixels), fine(pixels), detail(pixels), statistics(pixels), near(pixels) {}
};

/// Smooths irradiance (light over its modulation) scale by scale over pixels that see the same surface, and leaves of
/// each scale's detail what is light: the halves' covariance, where that is significant around a pixel, over that and
/// the noise, by which the halves differ (Wiener's filter). What this takes away goes through the same again. With more
/// passes every detail becomes significant, so that the image becomes the unfiltered one. Pixels on edges are mixtures
/// of the surfaces beside them.
class LightFilter {
 public:
  /// `halves`: even passes, then odd ones, each width · height pixels; at least a sample in each half.
  LightFilter(std::span<const FilmPixel> halves, int width, const SampleCounts& counts, int threads,
              HalvesBy halvesBy = HalvesBy::passes);
  /// Of a part of the light. By chessboard both halves of it are the same.
  [[nodiscard]] LightOfHalves clean(const LightOfHalves& light, OnEdges onEdges);

 private:
  void weighLight(std::span<const FilmPixel> halves, const SampleCounts& counts);
  void readRaw(const LightOfHalves& light);
  void splitByChessboard();
  void cleanRaw();
  void goThrough(const Halves& light, bool isFirst);
  void splitScale(int scale, bool isFirst);
  void keepLight(int scale);
  template <class Body>
  void forPixels(const Body& body) const;

  float evenShare_;
  int threads_;
  HalvesBy halvesBy_;
  std::size_t pixels_;
  SurfaceGuides guides_;
  SurfaceSmoother smoother_;
  LightWeights weights_;
  LightAtHand light_;
  ScaleAtHand scale_;
};

}  // namespace importon
