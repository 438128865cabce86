/// What of two halves' deviations is light, and what noise.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "render/filter/halves.h"

namespace importon {

/// By pixel, of deviations a and b of the even and the odd half: a b, (a - b)², and the squares of these. They are to
/// be averaged over windows.
class HalfStatistics {
 public:
  explicit HalfStatistics(std::size_t pixels) {
    for (Plane* plane : planes_) plane->resize(pixels);
  }
  HalfStatistics(const HalfStatistics&) = delete;
  HalfStatistics& operator=(const HalfStatistics&) = delete;

  /// `product`: a b, `apart`: (a - b)², sums over channels.
  void set(std::size_t i, float product, float apart) {
    product = std::clamp(product, -kMost, kMost);
    apart = std::min(apart, kMost);
    product_[i] = product;
    apart_[i] = apart;
    apartSquare_[i] = apart * apart;
  }
  [[nodiscard]] std::span<Plane* const> planes() { return planes_; }

  /// How much of the deviation of both halves' mean is to be kept for the least squared error: its variance over that
  /// and the noise's [Wiener], the former only as far as it is significant. `details`: independent ones in the window.
  /// Were all noise, the mean product would have the variance E[(a - b)⁴] / 12 over their number, if it is normal, and
  /// less if it has outliers.
  [[nodiscard]] float shareOfLight(std::size_t i, float details, float evenShare) const {
    const float error = std::sqrt(apartSquare_[i] / (12 * details));
    const float errors = product_[i] / std::max(error, std::numeric_limits<float>::min());
    return shareOfProduct(i, evenShare) * std::clamp((errors - kNoise) / (kLight - kNoise), 0.0f, 1.0f);
  }

  /// The same, whether it is significant or not.
  [[nodiscard]] float shareOfProduct(std::size_t i, float evenShare) const {
    return product_[i] > 0 ? product_[i] / (product_[i] + evenShare * (1 - evenShare) * apart_[i]) : 0.0f;
  }

 private:
  static constexpr float kMost = 1e15f;  // whose square is finite
  /// Standard errors below which a deviation counts for noise, and above which for light.
  static constexpr float kNoise = 1, kLight = 2.5f;

  Plane product_, apart_, apartSquare_;
  std::array<Plane*, 3> planes_{&product_, &apart_, &apartSquare_};
};

}  // namespace importon
