#include "report/false_color.h"

#include <cmath>

namespace importon {

std::array<std::uint8_t, 3> falseColor(float value) {
  constexpr std::size_t kSteps = 5;
  constexpr std::array<std::array<float, 3>, kSteps + 1> kStops{
      {{0, 0, 0}, {58, 16, 96}, {154, 32, 98}, {228, 92, 42}, {250, 182, 56}, {255, 252, 220}}};
  const float at = (value < 1 ? std::fmax(value, 0.F) : 1.F) * static_cast<float>(kSteps);
  const std::size_t step = std::min(static_cast<std::size_t>(at), kSteps - 1);
  const float share = at - static_cast<float>(step);
  std::array<std::uint8_t, 3> color{};
  for (std::size_t c = 0; c < 3; ++c) {
    const float mixed = kStops[step][c] + share * (kStops[step + 1][c] - kStops[step][c]);
    color[c] = static_cast<std::uint8_t>(std::lround(mixed));
  }
  return color;
}

PngPixels falseColors(int width, int height, std::span<const float> values) {
  PngPixels pixels{width, height, {}};
  pixels.rgb.reserve(3 * values.size());
  for (const float value : values) {
    for (const std::uint8_t part : falseColor(value)) pixels.rgb.push_back(part);
  }
  return pixels;
}

}  // namespace importon
