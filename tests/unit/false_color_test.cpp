#include "report/false_color.h"

#include <gtest/gtest.h>

#include <limits>

#include "io/tone_map.h"

namespace importon {
namespace {

/// Relative luminance of what is shown.
float luminanceOf(float value) {
  const auto color = falseColor(value);
  const auto linear = [&](std::size_t c) { return linearFromSrgb(static_cast<float>(color[c]) / 255); };
  return 0.2126F * linear(0) + 0.7152F * linear(1) + 0.0722F * linear(2);
}

TEST(FalseColor, GetsLighterAllAlong) {
  for (int i = 0; i < 50; ++i) {
    EXPECT_LT(luminanceOf(static_cast<float>(i) / 50), luminanceOf(static_cast<float>(i + 1) / 50)) << i;
  }
}

TEST(FalseColor, EndsAtItsEnds) {
  EXPECT_EQ(falseColor(0), falseColor(-3));
  EXPECT_EQ(falseColor(1), falseColor(7));
  EXPECT_EQ(falseColor(1), falseColor(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_EQ(luminanceOf(0), 0);
}

TEST(FalseColor, PaintsPixelsInOrder) {
  const std::vector<float> values{0, 1};
  const PngPixels pixels = falseColors(2, 1, values);
  ASSERT_EQ(pixels.rgb.size(), 6u);
  EXPECT_EQ(pixels.rgb[0], 0);
  EXPECT_EQ(pixels.rgb[3], falseColor(1)[0]);
}

}  // namespace
}  // namespace importon
