/// The tables of sheen, for make_albedo_table.cpp: the same lobe as shaders/lib/sheen.glsl.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "shared/albedo_table.h"

namespace importon {

/// Charlie's lobe, of white sheen. [Estevez and Kulla 2017, eq. 2 and 3]
class SheenLobe {
 public:
  explicit SheenLobe(double alpha) : alpha_(std::max(alpha, static_cast<double>(kLeastSheenAlpha))) {}

  /// Share of light along `cosine` that is reflected if `bound(cosine of the light)` bounds the value, too.
  template <class Bound>
  double albedo(double cosine, const Bound& bound) const {
    constexpr int kSide = 160;
    const double sine = std::sqrt(1 - cosine * cosine);
    std::array<double, kSide> turns;
    for (int j = 0; j < kSide; ++j) turns[j] = std::cos((j + 0.5) / kSide * kPi);
    double sum = 0;
    for (int i = 0; i < kSide; ++i) {
      const double z = (i + 0.5) / kSide, s = std::sqrt(1 - z * z), h2 = (cosine + z) * (cosine + z);
      double row = 0;
      for (const double turn : turns) {
        const double across2 = std::max(0.0, sine * sine + s * s + 2 * sine * s * turn);
        row += std::pow(across2 / (across2 + h2), 0.5 / alpha_);
      }
      sum += bound(z) * row / (1 + lambda(cosine) + lambda(z));
    }
    return sum / (kSide * kSide) * (2 + 1 / alpha_) / (4 * cosine);
  }

 private:
  static constexpr double kPi = 3.14159265358979323846;
  double fit(double x) const {
    const double t = (1 - alpha_) * (1 - alpha_);
    const auto between = [t](double sharp, double soft) { return soft + t * (sharp - soft); };
    return between(21.5473, 25.3245) / (1 + between(3.82987, 3.32435) * std::pow(x, between(0.19823, 0.16801))) +
           between(-1.97760, -1.27393) * x + between(-4.32054, -4.85967);
  }
  double lambda(double cosine) const { return std::exp(cosine < 0.5 ? fit(cosine) : 2 * fit(0.5) - fit(1 - cosine)); }
  double alpha_;
};

/// Rows of cosines for each alpha. x: what is reflected; y: the bound, that keeps it at 1 at most.
inline std::vector<std::array<double, 2>> sheenTable() {
  std::vector<std::array<double, 2>> texels;
  const auto at = [](unsigned i) { return std::pow(std::max(i / (kSheenSide - 1.0), 0.03), 2); };
  for (unsigned j = 0; j < kSheenSide; ++j) {
    const SheenLobe lobe(std::pow(j / (kSheenSide - 1.0), 2));
    std::array<double, kSheenSide> bounds{};
    for (unsigned i = 0; i < kSheenSide; ++i)
      bounds[i] = 1 / std::max(1.0, lobe.albedo(at(i), [](double) { return 1.0; }));
    for (unsigned i = 0; i < kSheenSide; ++i) {
      const auto bound = [&](double cosine) {
        const double place = std::sqrt(cosine) * (kSheenSide - 1.0);
        const auto k = std::min(static_cast<std::size_t>(place), std::size_t{kSheenSide - 2});
        const double between = bounds[k] + (place - static_cast<double>(k)) * (bounds[k + 1] - bounds[k]);
        return std::min(between, bounds[i]);
      };
      texels.push_back({lobe.albedo(at(i), bound), bounds[i]});
    }
  }
  return texels;
}

}  // namespace importon
