#include "io/tone_map.h"

#include <cmath>

#include "base/error.h"

namespace importon {
namespace {

// Luminance of linear Rec. 709 RGB.
float luminance(float r, float g, float b) { return 0.2126F * r + 0.7152F * g + 0.0722F * b; }

}  // namespace

std::array<std::span<const float>, 3> rgbOf(const Image& image, const std::string& where) {
  std::array<std::span<const float>, 3> planes;
  constexpr std::array<const char*, 3> kNames{"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    const Channel* channel = image.find(kNames[c]);
    if (channel == nullptr) {
      throw SceneError(std::string("the image has no channel ") + kNames[c], where, "give an image with R, G and B");
    }
    planes[c] = channel->values;
  }
  return planes;
}

float autoExposure(const Image& image, const std::string& where) {
  constexpr double kMiddleGrey = 0.18, kFloor = 1e-3;
  const auto rgb = rgbOf(image, where);
  const auto forEachLit = [&](const auto& visit) {
    for (std::size_t i = 0; i < rgb[0].size(); ++i) {
      const float y = luminance(rgb[0][i], rgb[1][i], rgb[2][i]);
      if (std::isfinite(y) && y > 0) visit(static_cast<double>(y));
    }
  };
  double sum = 0, count = 0;
  forEachLit([&](double y) { sum += y, count += 1; });
  if (count == 0) return 1;
  const double floor = kFloor * sum / count;
  double logSum = 0;
  forEachLit([&](double y) { logSum += std::log(std::max(y, floor)); });
  return static_cast<float>(kMiddleGrey / std::exp(logSum / count));
}

float filmicShoulder(float exposed) {
  constexpr float kJoint = 0.5F;
  if (!(exposed > 0)) return 0;
  if (exposed <= kJoint) return exposed;
  return kJoint + (1 - kJoint) * (1 - std::exp(-(exposed - kJoint) / (1 - kJoint)));
}

float srgbFromLinear(float linear) {
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F;
}

float linearFromSrgb(float srgb) { return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F); }

}  // namespace importon
