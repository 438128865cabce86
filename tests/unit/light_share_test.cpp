// What a caustic adds to the light that is there besides, and how many of its photons that asks for.
#include "render/importance/light_share.h"

#include <gtest/gtest.h>

namespace importon {
namespace {

/// On the unit square: even light of 1 W in all, and in its left half a caustic of `caustic` W, which is in both maps.
std::vector<LightPoint> lightWith(float caustic) {
  constexpr int kSide = 32;
  constexpr float kEven = 1.0f / (kSide * kSide);
  std::vector<LightPoint> points;
  for (int i = 0; i < kSide * kSide; ++i) {
    const vec3 place((static_cast<float>(i % kSide) + 0.5f) / kSide, 0.0f,
                     (static_cast<float>(i / kSide) + 0.5f) / kSide);
    points.push_back({place, kEven, false});
    if (place.x > 0.5f) continue;
    points.push_back({place, 2 * caustic * kEven, false});
    points.push_back({place, 2 * caustic * kEven, true});
  }
  return points;
}

TEST(LightShare, IsTheCausticsInAllLight) {
  const LightShare share(lightWith(0.25f), vec3(0), 1);
  EXPECT_NEAR(share.at({0.2f, 0, 0.4f}), 0.5 / 1.5, 1e-6);
  EXPECT_NEAR(share.requiredShareAt({0.2f, 0, 0.4f}), 1.0 / 9, 1e-6) << "photons go with its square";
  EXPECT_EQ(share.at({0.8f, 0, 0.4f}), 0);
  EXPECT_EQ(share.requiredShareAt({0.8f, 0, 0.4f}), 1.0 / 64) << "never none: a pilot may have missed a caustic";
}

TEST(LightShare, OfACausticAloneIsAll) {
  std::vector<LightPoint> points = lightWith(0.5f);
  std::erase_if(points, [](const LightPoint& point) { return !point.isCaustic; });
  EXPECT_EQ(LightShare(points, vec3(0), 1).at({0.2f, 0, 0.4f}), 1);
  EXPECT_EQ(LightShare({}, vec3(0), 1).at({0.2f, 0, 0.4f}), 1) << "no light at all";
}

}  // namespace
}  // namespace importon
