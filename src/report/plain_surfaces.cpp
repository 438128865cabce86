#include "report/plain_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "io/tone_map.h"

namespace importon {
namespace {

constexpr int kFlatRadius = 2;            // pixels around one that must show its surface
constexpr double kLikeNormal = 0.999;     // cosine
constexpr double kOffPlane = 0.02;        // of the distance to a neighbour
constexpr double kStepOfLight = 0.25;     // of the radiance there: an edge of direct light
constexpr double kSmall = 2, kLarge = 8;  // standard deviations of the band's Gaussians, pixels

/// Values by pixel, of which those without weight are not known.
struct Masked {
  int width, height;
  std::vector<double> values, weights;

  Masked(int w, int h) : width(w), height(h), values(size(w, h)), weights(values.size()) {}
  static std::size_t size(int w, int h) { return static_cast<std::size_t>(w) * static_cast<std::size_t>(h); }
  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

using Layer = std::array<const std::vector<float>*, 3>;

std::optional<Layer> layerOf(const Image& image, const std::string& name, const char* suffixes) {
  Layer layer{};
  for (std::size_t c = 0; c < 3; ++c) {
    const Channel* channel = image.find(name + "." + suffixes[c]);
    if (channel == nullptr) return {};
    layer[c] = &channel->values;
  }
  return layer;
}

std::array<double, 3> read(const Layer& layer, std::size_t i) {
  return {static_cast<double>((*layer[0])[i]), static_cast<double>((*layer[1])[i]),
          static_cast<double>((*layer[2])[i])};
}

double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double sumOf(const std::array<double, 3>& v) { return v[0] + v[1] + v[2]; }

/// Of ITU-R BT.709.
double luminance(const std::array<double, 3>& rgb) { return dot(rgb, {0.2126, 0.7152, 0.0722}); }

/// Logarithm of the luminance where it is finite and positive, and the pixel plain.
Masked logarithms(const Image& image, const PlainSurfaces& plain) {
  const auto rgb = rgbOf(image, "the image");
  Masked plane(image.width, image.height);
  for (std::size_t i = 0; i < plane.values.size(); ++i) {
    const double y =
        luminance({static_cast<double>(rgb[0][i]), static_cast<double>(rgb[1][i]), static_cast<double>(rgb[2][i])});
    if (!plain.isPlain[i] || !(y > 0) || !std::isfinite(y)) continue;
    plane.values[i] = std::log(y);
    plane.weights[i] = 1;
  }
  return plane;
}

/// Weighted means over a kernel of `half` pixels to each side, along x and then y; what has no weight is left out.
Masked smooth(const Masked& plane, const std::vector<double>& half) {
  const int radius = static_cast<int>(half.size()) - 1;
  const auto along = [&](const Masked& from, bool isX, bool isLast) {
    Masked to(from.width, from.height);
    for (int y = 0; y < from.height; ++y)
      for (int x = 0; x < from.width; ++x) {
        double sum = 0, weight = 0;
        const int here = isX ? x : y, end = isX ? from.width : from.height;
        for (int q = std::max(here - radius, 0); q <= std::min(here + radius, end - 1); ++q) {
          const std::size_t j = isX ? from.at(q, y) : from.at(x, q);
          const double k = half[static_cast<std::size_t>(std::abs(q - here))];
          sum += k * from.values[j];
          weight += k * from.weights[j];
        }
        const std::size_t i = from.at(x, y);
        to.values[i] = isLast ? (weight > 0 ? sum / weight : 0) : sum;
        to.weights[i] = weight;
      }
    return to;
  };
  Masked weighted = plane;
  for (std::size_t i = 0; i < weighted.values.size(); ++i) weighted.values[i] *= weighted.weights[i];
  return along(along(weighted, true, false), false, true);
}

std::vector<double> gaussian(double sigma) {
  std::vector<double> half;
  for (int k = 0; k <= static_cast<int>(std::ceil(3 * sigma)); ++k)
    half.push_back(std::exp(-k * k / (2 * sigma * sigma)));
  return half;
}

/// `values` in any order, at least one.
double percentile(std::vector<double> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

/// Whether pixel j shows the surface of pixel i, in light without a step.
struct Likeness {
  Layer normal, position;
  std::optional<Layer> direct;
  std::vector<double> radiance;

  [[nodiscard]] bool isLike(std::size_t i, std::size_t j) const {
    const auto n = read(normal, i), m = read(normal, j), p = read(position, i), q = read(position, j);
    const std::array<double, 3> d{q[0] - p[0], q[1] - p[1], q[2] - p[2]};
    if (!(dot(n, m) >= kLikeNormal)) return false;
    if (!(std::abs(dot(d, n)) <= kOffPlane * std::sqrt(dot(d, d)) + 1e-9)) return false;
    if (!direct) return true;
    const double step = std::abs(sumOf(read(*direct, i)) - sumOf(read(*direct, j)));
    return step <= kStepOfLight * std::max(radiance[i], radiance[j]);
  }
};

}  // namespace

PlainSurfaces findPlainSurfaces(const Image& layers, const Image& color) {
  const std::size_t pixels = Masked::size(layers.width, layers.height);
  PlainSurfaces plain{std::vector<bool>(pixels, true), false};
  const auto normal = layerOf(layers, "N", "XYZ"), position = layerOf(layers, "P", "XYZ");
  if (!normal || !position) return plain;
  plain.isKnown = true;
  Likeness like{*normal, *position, layerOf(layers, "direct", "RGB"), std::vector<double>(pixels)};
  const auto rgb = rgbOf(color, "the image");
  for (std::size_t i = 0; i < pixels; ++i)
    like.radiance[i] = static_cast<double>(rgb[0][i]) + static_cast<double>(rgb[1][i]) + static_cast<double>(rgb[2][i]);
  const Masked at(layers.width, layers.height);
  for (int y = 0; y < layers.height; ++y)
    for (int x = 0; x < layers.width; ++x) {
      const std::size_t i = at.at(x, y);
      bool isPlain = dot(read(*normal, i), read(*normal, i)) > 0.5;
      for (int v = std::max(y - kFlatRadius, 0); isPlain && v <= std::min(y + kFlatRadius, layers.height - 1); ++v)
        for (int u = std::max(x - kFlatRadius, 0); isPlain && u <= std::min(x + kFlatRadius, layers.width - 1); ++u)
          isPlain = like.isLike(i, at.at(u, v));
      plain.isPlain[i] = isPlain;
    }
  return plain;
}

PlainSurfaces findPlainSurfaces(const Image& wholeReference, const Image& reference, const Image& whole,
                                const Image& image) {
  PlainSurfaces plain = findPlainSurfaces(wholeReference, reference);
  return plain.isKnown ? plain : findPlainSurfaces(whole, image);
}

BandError bandError(const Image& image, const Image& reference, const PlainSurfaces& plain) {
  Masked ratio = logarithms(image, plain);
  const Masked truth = logarithms(reference, plain);
  for (std::size_t i = 0; i < ratio.values.size(); ++i) {
    ratio.values[i] -= truth.values[i];
    ratio.weights[i] *= truth.weights[i];
  }
  const Masked small = smooth(ratio, gaussian(kSmall)), large = smooth(ratio, gaussian(kLarge));
  std::vector<double> band;
  double squares = 0;
  for (std::size_t i = 0; i < ratio.values.size(); ++i) {
    if (ratio.weights[i] == 0) continue;
    band.push_back(std::abs(small.values[i] - large.values[i]));
    squares += band.back() * band.back();
  }
  if (band.empty()) return {};
  return {std::sqrt(squares / static_cast<double>(band.size())), percentile(band, 0.95), percentile(band, 0.99),
          band.size()};
}

double grainRatio(const Image& image, const PlainSurfaces& plain) {
  Masked fine = logarithms(image, plain);
  const Masked coarse = smooth(fine, {1, 1});
  for (std::size_t i = 0; i < fine.values.size(); ++i) fine.values[i] -= coarse.values[i];
  Masked squared = fine;
  for (double& value : squared.values) value *= value;
  const Masked mean = smooth(fine, {1, 1, 1}), meanSquare = smooth(squared, {1, 1, 1});
  std::vector<double> grain;
  for (std::size_t i = 0; i < fine.values.size(); ++i)
    if (fine.weights[i] > 0)
      grain.push_back(std::sqrt(std::max(meanSquare.values[i] - mean.values[i] * mean.values[i], 0.0)));
  if (grain.empty()) return 0;
  const double usual = percentile(grain, 0.25);
  return usual > 0 ? percentile(std::move(grain), 0.995) / usual : 0;
}

}  // namespace importon
