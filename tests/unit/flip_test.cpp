#include "report/flip.h"

#include <gtest/gtest.h>

#include <functional>

namespace importon {
namespace {

using Color = std::array<float, 3>;

ShownImage shown(int width, int height, const std::function<Color(int x, int y)>& colorAt) {
  ShownImage image{width, height, {}, std::vector<bool>(static_cast<std::size_t>(width * height))};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Color color = colorAt(x, y);
      for (std::size_t c = 0; c < 3; ++c) image.rgb[c].push_back(color[c]);
    }
  }
  return image;
}

ShownImage even(const Color& color) {
  return shown(3, 2, [&](int, int) { return color; });
}

// Even images have no features and filters leave them as they are: only the colour difference remains. By hand:
// HyAB(black, white) = 100, 100^0.7 = 25.119, the greatest, green against blue, is 41.276, the knee 16.510;
// 0.95 + 0.05 (25.119 - 16.510)/(41.276 - 16.510) = 0.96738.
TEST(Flip, OfEvenImagesIsTheirColorDifference) {
  EXPECT_NEAR(ldrFlip(even({0, 0, 0}), even({1, 1, 1})), 0.967380, 1e-4);
  EXPECT_NEAR(ldrFlip(even({0, 1, 0}), even({0, 0, 1})), 1, 1e-4);
  EXPECT_NEAR(ldrFlip(even({0.2F, 0.2F, 0.2F}), even({0.25F, 0.2F, 0.2F})), 0.153705, 1e-4);
}

TEST(Flip, IsZeroForEqualImagesAndSymmetric) {
  const ShownImage grey = even({0.5F, 0.5F, 0.5F}), red = even({0.9F, 0.1F, 0});
  EXPECT_EQ(ldrFlip(grey, grey), 0);
  EXPECT_EQ(ldrFlip(grey, red), ldrFlip(red, grey));
}

// Against a plain two-dimensional evaluation of the paper's formulas in double precision.
TEST(Flip, AgreesWithAnEvaluationByTheFormulas) {
  const ShownImage a = shown(9, 7, [](int x, int y) {
    const auto value = [&](int c) { return static_cast<float>((x * 5 + y * 3 + c * 2) % 7) / 7; };
    return Color{value(0), value(1), value(2)};
  });
  const ShownImage b = shown(9, 7, [](int x, int y) {
    const auto value = [&](int c) { return static_cast<float>((x * 3 + y * 5 + c * 4) % 5) / 5; };
    return Color{value(0), value(1), value(2)};
  });
  const std::vector<float> map = ldrFlipMap(a, b);
  ASSERT_EQ(map.size(), 63u);
  EXPECT_NEAR(map[0], 0.801064, 2e-4);
  EXPECT_NEAR(map[31], 0.342140, 2e-4);
  EXPECT_NEAR(map[62], 0.509364, 2e-4);
  EXPECT_NEAR(ldrFlip(a, b), 0.445894, 1e-4);
}

TEST(Flip, SeesABrightPixelMoreThanAFaintOne) {
  const auto withDot = [](float value) {
    return shown(32, 32, [value](int x, int y) {
      const float level = x == 16 && y == 16 ? value : 0.2F;
      return Color{level, level, level};
    });
  };
  const ShownImage plain = withDot(0.2F);
  const std::vector<float> faint = ldrFlipMap(withDot(0.3F), plain), bright = ldrFlipMap(withDot(1), plain);
  EXPECT_GT(bright[16 * 32 + 16], faint[16 * 32 + 16]);
  EXPECT_GT(faint[16 * 32 + 16], 0);
  EXPECT_EQ(bright[0], 0);
}

TEST(Flip, GivesBrokenPixelsTheGreatestError) {
  ShownImage broken = even({0.5F, 0.5F, 0.5F});
  broken.isBroken[2] = true;
  const std::vector<float> map = ldrFlipMap(broken, even({0.5F, 0.5F, 0.5F}));
  EXPECT_EQ(map[2], 1);
  EXPECT_EQ(map[1], 0);
}

}  // namespace
}  // namespace importon
