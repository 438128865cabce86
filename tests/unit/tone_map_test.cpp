#include "io/tone_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"

namespace importon::tone_map_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Image grey(std::vector<float> values) {
  Image image;
  image.width = static_cast<int>(values.size());
  image.height = 1;
  for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, values});
  return image;
}

TEST(ToneMap, ExposesTheLogAverageToMiddleGrey) {
  // Geometric mean of 1 and 4 is 2.
  EXPECT_NEAR(autoExposure(grey({1, 4}), ""), 0.09F, 1e-6F);
}

TEST(ToneMap, ExposureLeavesOutWhatIsBlackOrNotFinite) {
  EXPECT_NEAR(autoExposure(grey({1, 4, 0, 0, kNan, kInfinity, -3}), ""), 0.09F, 1e-6F);
  EXPECT_EQ(autoExposure(grey({0, 0}), ""), 1);
}

TEST(ToneMap, ExposureScalesWithTheLight) {
  EXPECT_FLOAT_EQ(autoExposure(grey({1, 1e-6F, 3}), ""), 64 * autoExposure(grey({64, 64e-6F, 192}), ""));
}

TEST(ToneMap, ShoulderIsTheIdentityBelowTheJointAndOneAtInfinity) {
  EXPECT_EQ(filmicShoulder(0), 0);
  EXPECT_EQ(filmicShoulder(0.3F), 0.3F);
  EXPECT_EQ(filmicShoulder(0.5F), 0.5F);
  EXPECT_NEAR(filmicShoulder(1), 0.5F + 0.5F * (1 - std::exp(-1.F)), 1e-6F);
  EXPECT_EQ(filmicShoulder(kInfinity), 1);
  EXPECT_EQ(filmicShoulder(kNan), 0);
  EXPECT_EQ(filmicShoulder(-1), 0);
}

TEST(ToneMap, ShoulderHasNoKink) {
  const float step = 1e-3F;
  EXPECT_NEAR((filmicShoulder(0.5F + step) - filmicShoulder(0.5F)) / step, 1, 2e-3F);
}

TEST(ToneMap, SrgbHasItsPublishedValues) {
  EXPECT_EQ(srgbFromLinear(0), 0);
  EXPECT_NEAR(srgbFromLinear(1), 1, 1e-6F);
  EXPECT_NEAR(srgbFromLinear(0.0031308F), 0.04045F, 1e-5F);
  EXPECT_NEAR(srgbFromLinear(0.214041F), 0.5F, 1e-5F);
}

TEST(ToneMap, SrgbInverts) {
  for (float x = 0; x <= 1; x += 0.01F) EXPECT_NEAR(linearFromSrgb(srgbFromLinear(x)), x, 1e-6F);
}

TEST(ToneMap, NeedsRedGreenAndBlue) {
  Image image = grey({1});
  image.channels.pop_back();
  EXPECT_THROW((void)autoExposure(image, "a.exr"), SceneError);
}

}  // namespace
}  // namespace importon::tone_map_test
