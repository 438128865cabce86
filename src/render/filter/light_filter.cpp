#include "render/filter/light_filter.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/parallel.h"
#include "render/filter/edge_mixtures.h"

namespace importon {
namespace {

constexpr int kRounds = 2;  // the second takes up what the first took for noise though it is light
/// Levels over which the statistics of a detail are averaged, from its own on; and those of a smaller window.
constexpr int kWindowLevels = 3, kNearLevels = 2;

float ratio(float light, float modulation) { return modulation > 0 ? light / modulation : 0.0f; }

}  // namespace

template <class Body>
void LightFilter::forPixels(const Body& body) const {
  parallelFor(pixels_, 1u << 13, threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

LightFilter::LightFilter(std::span<const FilmPixel> halves, int width, const SampleCounts& counts, int threads,
                         HalvesBy halvesBy)
    : evenShare_(counts.evenShare()),
      threads_(threads),
      halvesBy_(halvesBy),
      pixels_(halves.size() / 2),
      guides_(readGuides(halves, width, counts, threads)),
      smoother_(guides_, kFilterScales + kWindowLevels - 1, threads),
      light_(pixels_),
      scale_(pixels_) {
  weighLight(halves, counts);
}

/// What glass shows is shared with its modulation: that differs by chance from path to path.
void LightFilter::weighLight(std::span<const FilmPixel> halves, const SampleCounts& counts) {
  weights_.own = planesOf(pixels_);
  forPixels([&](std::size_t i) {
    const bool isGlass = guides_.kind[i] == PixelKind::glass;
    const vec3 even = halves[i].modulation / counts.even(i), odd = halves[pixels_ + i].modulation / counts.odd(i);
    for (std::size_t c = 0; c < 3; ++c) {
      const int channel = static_cast<int>(c);
      weights_.own[c][i] = isGlass ? 1.0f : evenShare_ * even[channel] + (1 - evenShare_) * odd[channel];
    }
  });
  Planes smoothed = weights_.own;
  std::array<Plane*, 3> planes{&smoothed[0], &smoothed[1], &smoothed[2]};
  for (int scale = 0; scale < kFilterScales; ++scale) {
    smoother_.smooth(planes, scale);
    weights_.smooth[static_cast<std::size_t>(scale)] = smoothed;
  }
}

LightOfHalves LightFilter::clean(const LightOfHalves& light, OnEdges onEdges) {
  LightOfHalves result = light;
  const auto isDark = [](const std::vector<vec3>& half) {
    return std::all_of(half.begin(), half.end(), [](const vec3& radiance) { return radiance == vec3(0); });
  };
  if (isDark(light.even) && isDark(light.odd)) return result;
  readRaw(light);
  cleanRaw();
  if (onEdges == OnEdges::mixture)
    mixEdges(smoother_, weights_.own, light_.raw, evenShare_, light_.leastSquare, light_.shown);
  forPixels([&](std::size_t i) {
    if (guides_.kind[i] == PixelKind::none) return;
    for (std::size_t c = 0; c < 3; ++c) {
      if (!(weights_.own[c][i] > 0)) continue;
      result.even[i][static_cast<int>(c)] = weights_.own[c][i] * light_.shown.planes[kEven + c][i];
      result.odd[i][static_cast<int>(c)] = weights_.own[c][i] * light_.shown.planes[kOdd + c][i];
    }
  });
  return result;
}

void LightFilter::readRaw(const LightOfHalves& light) {
  forPixels([&](std::size_t i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const int channel = static_cast<int>(c);
      light_.raw.planes[kEven + c][i] = ratio(light.even[i][channel], weights_.own[c][i]);
      light_.raw.planes[kOdd + c][i] = ratio(light.odd[i][channel], weights_.own[c][i]);
    }
  });
  if (halvesBy_ == HalvesBy::chessboard) splitByChessboard();
  double sum = 0;
  for (const Plane& plane : light_.raw.planes) sum = std::accumulate(plane.begin(), plane.end(), sum);
  const double mean = sum / static_cast<double>(pixels_);
  light_.leastSquare = std::max(static_cast<float>(0.01 * mean * mean), std::numeric_limits<float>::min());
}

/// From the same light in both halves. A pixel that has none of the other colour beside it stays as it is.
void LightFilter::splitByChessboard() {
  const Planes whole{light_.raw.planes[kEven], light_.raw.planes[kEven + 1], light_.raw.planes[kEven + 2]};
  forPixels([&](std::size_t i) {
    const int x = static_cast<int>(i) % guides_.width, y = static_cast<int>(i) / guides_.width;
    std::array<float, 6> sum{}, weight{};
    for (int qy = std::max(y - 1, 0); qy <= std::min(y + 1, guides_.height - 1); ++qy)
      for (int qx = std::max(x - 1, 0); qx <= std::min(x + 1, guides_.width - 1); ++qx) {
        const std::size_t q = guides_.at(qx, qy);
        if (q != i && !guides_.areAlike(i, q)) continue;
        const std::size_t half = (qx + qy) % 2 == 0 ? kEven : kOdd;
        for (std::size_t c = 0; c < 3; ++c) {
          sum[half + c] += weights_.own[c][q] * whole[c][q];
          weight[half + c] += weights_.own[c][q];
        }
      }
    for (std::size_t c = 0; c < 6; ++c)
      if (weight[c] > 0 && weight[(c + 3) % 6] > 0) light_.raw.planes[c][i] = sum[c] / weight[c];
  });
}

void LightFilter::cleanRaw() {
  for (Plane& plane : light_.shown.planes) std::fill(plane.begin(), plane.end(), 0.0f);
  goThrough(light_.raw, true);
  for (int round = 1; round < (halvesBy_ == HalvesBy::passes ? kRounds : 1); ++round) {
    forPixels([&](std::size_t i) {
      float sum = 0;
      for (std::size_t c = 0; c < 6; ++c) {
        light_.rest.planes[c][i] = light_.raw.planes[c][i] - light_.shown.planes[c][i];
        sum += light_.shown.planes[c][i];
      }
      light_.importance[i] = importanceOf(sum, light_.leastSquare);
    });
    goThrough(light_.rest, false);
  }
}

/// Adds to what is shown what is light in `light`.
void LightFilter::goThrough(const Halves& light, bool isFirst) {
  forPixels([&](std::size_t i) {
    for (std::size_t c = 0; c < 6; ++c) {
      scale_.fine.planes[c][i] = light.planes[c][i];
      scale_.sums.planes[c][i] = light.planes[c][i] * weights_.own[c % 3][i];
    }
  });
  for (int scale = 0; scale < kFilterScales; ++scale) {
    splitScale(scale, isFirst);
    keepLight(scale);
  }
  forPixels([&](std::size_t i) {
    for (std::size_t c = 0; c < 6; ++c) light_.shown.planes[c][i] += scale_.fine.planes[c][i];
  });
}

/// The detail is what the next scale takes away. Its squares count by the importance: relative to what is there.
void LightFilter::splitScale(int scale, bool isFirst) {
  std::array<Plane*, 6> smoothed;
  std::transform(scale_.sums.planes.begin(), scale_.sums.planes.end(), smoothed.begin(),
                 [](Plane& plane) { return &plane; });
  const Planes& sumOfWeights = weights_.smooth[static_cast<std::size_t>(scale)];
  smoother_.smooth(smoothed, scale);
  forPixels([&](std::size_t i) {
    float sum = 0, product = 0, apart = 0;
    for (std::size_t c = 0; c < 6; ++c) {
      const float coarse = ratio(scale_.sums.planes[c][i], sumOfWeights[c % 3][i]);
      scale_.detail.planes[c][i] = scale_.fine.planes[c][i] - coarse;
      scale_.fine.planes[c][i] = coarse;
      sum += coarse;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const float even = scale_.detail.planes[kEven + c][i], odd = scale_.detail.planes[kOdd + c][i];
      product += even * odd;
      apart += (even - odd) * (even - odd);
    }
    const bool isShared = weights_.own[0][i] + weights_.own[1][i] + weights_.own[2][i] > 0;
    const float importance = !isShared ? 0.0f : isFirst ? importanceOf(sum, light_.leastSquare) : light_.importance[i];
    scale_.statistics.set(i, importance * product, importance * apart);
  });
}

void LightFilter::keepLight(int scale) {
  for (int k = 0; k < kWindowLevels; ++k) {
    smoother_.smooth(scale_.statistics.planes(), scale + k);
    if (k + 1 == kNearLevels)
      forPixels([&](std::size_t i) { scale_.near[i] = scale_.statistics.shareOfProduct(i, evenShare_); });
  }
  forPixels([&](std::size_t i) {
    const float gain =
        std::min(scale_.near[i], scale_.statistics.shareOfLight(i, smoother_.independentIn(i, scale), evenShare_));
    for (std::size_t c = 0; c < 6; ++c) light_.shown.planes[c][i] += gain * scale_.detail.planes[c][i];
  });
}

}  // namespace importon
