#include "render/filter/light_filter.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/parallel.h"
#include "render/filter/edge_mixtures.h"

namespace importon {
namespace {

constexpr int kScales = 6;  // the smoothest is a Gaussian of 37 pixels
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

LightFilter::LightFilter(std::span<const FilmPixel> halves, int width, const SampleCounts& counts, int threads)
    : film_(halves),
      counts_(counts),
      threads_(threads),
      pixels_(halves.size() / 2),
      guides_(readGuides(halves, width, counts, threads)),
      smoother_(guides_, kScales + kWindowLevels - 1, threads),
      modulation_(planesOf(pixels_)),
      weights_(planesOf(pixels_)),
      raw_(pixels_),
      shown_(pixels_),
      rest_(pixels_),
      sums_(pixels_),
      fine_(pixels_),
      detail_(pixels_),
      sumOfWeights_(planesOf(pixels_)),
      importance_(pixels_),
      near_(pixels_),
      statistics_(pixels_) {
  const float share = counts.evenShare();
  forPixels([&](std::size_t i) {
    const vec3 even = film_[i].modulation / counts_.even(i), odd = film_[pixels_ + i].modulation / counts_.odd(i);
    for (std::size_t c = 0; c < 3; ++c)
      modulation_[c][i] = share * even[static_cast<int>(c)] + (1 - share) * odd[static_cast<int>(c)];
  });
}

FilteredLight LightFilter::clean(vec3 FilmPixel::*light) {
  FilteredLight result{std::vector<vec3>(pixels_), std::vector<vec3>(pixels_)};
  if (std::all_of(film_.begin(), film_.end(), [&](const FilmPixel& p) { return p.*light == vec3(0); })) return result;
  readRaw(light);
  cleanRaw();
  // Other light may differ within a pixel: an edge is often one of a shadow, too.
  if (light == &FilmPixel::indirect) mixEdges(smoother_, weights_, raw_, counts_.evenShare(), shown_);
  forPixels([&](std::size_t i) {
    result.even[i] = film_[i].*light / counts_.even(i);
    result.odd[i] = film_[pixels_ + i].*light / counts_.odd(i);
    if (guides_.kind[i] == PixelKind::none) return;
    for (std::size_t c = 0; c < 3; ++c) {
      if (!(weights_[c][i] > 0)) continue;
      result.even[i][static_cast<int>(c)] = weights_[c][i] * shown_.planes[kEven + c][i];
      result.odd[i][static_cast<int>(c)] = weights_[c][i] * shown_.planes[kOdd + c][i];
    }
  });
  return result;
}

/// What glass shows is shared with its modulation: that differs by chance from path to path.
void LightFilter::readRaw(vec3 FilmPixel::*light) {
  forPixels([&](std::size_t i) {
    const FilmPixel &even = film_[i], &odd = film_[pixels_ + i];
    const bool isGlass = guides_.kind[i] == PixelKind::glass;
    for (std::size_t c = 0; c < 3; ++c) {
      const int channel = static_cast<int>(c);
      weights_[c][i] = isGlass ? 1.0f : modulation_[c][i];
      raw_.planes[kEven + c][i] = ratio((even.*light)[channel] / counts_.even(i), weights_[c][i]);
      raw_.planes[kOdd + c][i] = ratio((odd.*light)[channel] / counts_.odd(i), weights_[c][i]);
    }
  });
  double sum = 0;
  for (const Plane& plane : raw_.planes) sum = std::accumulate(plane.begin(), plane.end(), sum);
  const double mean = sum / static_cast<double>(pixels_);
  leastSquare_ = std::max(static_cast<float>(0.01 * mean * mean), std::numeric_limits<float>::min());
}

/// Of squared errors where the channels of both halves come to `sum`, as relMSE weighs them.
float LightFilter::importanceOf(float sum) const { return 1 / (sum * sum + leastSquare_); }

void LightFilter::cleanRaw() {
  for (Plane& plane : shown_.planes) std::fill(plane.begin(), plane.end(), 0.0f);
  goThrough(raw_, true);
  for (int round = 1; round < kRounds; ++round) {
    forPixels([&](std::size_t i) {
      float sum = 0;
      for (std::size_t c = 0; c < 6; ++c) {
        rest_.planes[c][i] = raw_.planes[c][i] - shown_.planes[c][i];
        sum += shown_.planes[c][i];
      }
      importance_[i] = importanceOf(sum);
    });
    goThrough(rest_, false);
  }
}

/// Adds to what is shown what is light in `light`.
void LightFilter::goThrough(const Halves& light, bool isFirst) {
  forPixels([&](std::size_t i) {
    for (std::size_t c = 0; c < 6; ++c) {
      fine_.planes[c][i] = light.planes[c][i];
      sums_.planes[c][i] = light.planes[c][i] * weights_[c % 3][i];
    }
    for (std::size_t c = 0; c < 3; ++c) sumOfWeights_[c][i] = weights_[c][i];
  });
  for (int scale = 0; scale < kScales; ++scale) {
    splitScale(scale, isFirst);
    keepLight(scale);
  }
  forPixels([&](std::size_t i) {
    for (std::size_t c = 0; c < 6; ++c) shown_.planes[c][i] += fine_.planes[c][i];
  });
}

/// The detail is what the next scale takes away. Its squares count by the importance: relative to what is there.
void LightFilter::splitScale(int scale, bool isFirst) {
  std::array<Plane*, 9> smoothed;
  for (std::size_t c = 0; c < 6; ++c) smoothed[c] = &sums_.planes[c];
  for (std::size_t c = 0; c < 3; ++c) smoothed[6 + c] = &sumOfWeights_[c];
  smoother_.smooth(smoothed, scale);
  forPixels([&](std::size_t i) {
    float sum = 0, product = 0, apart = 0;
    for (std::size_t c = 0; c < 6; ++c) {
      const float coarse = ratio(sums_.planes[c][i], sumOfWeights_[c % 3][i]);
      detail_.planes[c][i] = fine_.planes[c][i] - coarse;
      fine_.planes[c][i] = coarse;
      sum += coarse;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const float even = detail_.planes[kEven + c][i], odd = detail_.planes[kOdd + c][i];
      product += even * odd;
      apart += (even - odd) * (even - odd);
    }
    const bool isShared = weights_[0][i] + weights_[1][i] + weights_[2][i] > 0;
    const float importance = !isShared ? 0.0f : isFirst ? importanceOf(sum) : importance_[i];
    statistics_.set(i, importance * product, importance * apart);
  });
}

void LightFilter::keepLight(int scale) {
  const float evenShare = counts_.evenShare();
  for (int k = 0; k < kWindowLevels; ++k) {
    smoother_.smooth(statistics_.planes(), scale + k);
    if (k + 1 == kNearLevels) forPixels([&](std::size_t i) { near_[i] = statistics_.shareOfProduct(i, evenShare); });
  }
  forPixels([&](std::size_t i) {
    const float gain = std::min(near_[i], statistics_.shareOfLight(i, smoother_.independentIn(i, scale), evenShare));
    for (std::size_t c = 0; c < 6; ++c) shown_.planes[c][i] += gain * detail_.planes[c][i];
  });
}

}  // namespace importon
