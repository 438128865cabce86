#include "report/hdr_flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace importon::hdr_flip_test {
namespace {

Image grey(const std::vector<float>& values) {
  Image image{static_cast<int>(values.size()), 1, {}, {}};
  for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, values});
  return image;
}

std::vector<float> hdrFlip(const Image& test, const Image& reference) {
  return hdrFlipMap(test, "a.exr", reference, "ref.exr");
}

// The curve is 0.9036 x² + 0.018 x over 0.8748 x² + 0.354 x + 0.14; by hand 0.9216/1.3688 at 1, and 0.85 at the root
// 2.11888 of 0.16002 x² - 0.2829 x - 0.119.
TEST(HdrFlip, ShowsByTheAcesFit) {
  EXPECT_NEAR(acesCurve(1), 0.9216 / 1.3688, 1e-6);
  EXPECT_NEAR(acesCurve(2.11888F), 0.85, 1e-5);
  EXPECT_EQ(acesCurve(0), 0);
  EXPECT_EQ(acesCurve(-1), 0);
  EXPECT_EQ(acesCurve(std::numeric_limits<float>::max()), 1);
}

// log2(2.11888) = 1.08330; the brightest is 16 = 2^4, the median of 0.25, 0.5, 1, 16 is 0.75.
TEST(HdrFlip, LooksFromTheBrightestToTheMedian) {
  const ExposureRange range = exposureRange(std::vector<double>{16, 0.25, 1, 0.5});
  EXPECT_NEAR(range.start, 1.08330 - 4, 1e-4);
  EXPECT_NEAR(range.stop, 1.08330 + std::log2(1 / 0.75), 1e-4);
  EXPECT_EQ(range.count, 5);  // 4.415 stops
  EXPECT_EQ(exposureRange(std::vector<double>{3, 3, 3}).count, 2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NEAR(exposureRange(std::vector<double>{nan, 1}).start, 1.08330, 1e-4);
  EXPECT_TRUE(std::isfinite(exposureRange(std::vector<double>{0, 0}).stop));
}

// The reference is shown at 0.85, twice its light at 0.93967. L* is 93.8831 and 97.6179;
// 3.7348^0.7 · 0.95/16.510 = 0.144739.
TEST(HdrFlip, OfEvenImagesIsTheColorDifferenceAtTheOneExposure) {
  for (const float level : {1e-3F, 1.F, 1e3F}) {
    for (const float error : hdrFlip(grey({2 * level, 2 * level}), grey({level, level}))) {
      EXPECT_NEAR(error, 0.144739, 2e-4);
    }
  }
}

TEST(HdrFlip, SeesDifferencesInTheDarkAndInTheBright) {
  std::vector<float> truth(400, 0.01F);
  std::fill(truth.begin() + 300, truth.end(), 100.F);
  std::vector<float> dark = truth, bright = truth;
  std::fill(dark.begin(), dark.begin() + 200, 0.02F);
  std::fill(bright.begin() + 350, bright.end(), 200.F);
  const std::vector<float> inDark = hdrFlip(grey(dark), grey(truth)), inBright = hdrFlip(grey(bright), grey(truth));
  EXPECT_GT(inDark[50], 0.1F);
  EXPECT_GT(inBright[390], 0.1F);
  EXPECT_EQ(inDark[390], 0);
}

TEST(HdrFlip, GivesPixelsThatAreNotFiniteTheGreatestError) {
  const std::vector<float> map = hdrFlip(grey({std::numeric_limits<float>::infinity(), 1}), grey({1, 1}));
  EXPECT_EQ(map[0], 1);
  EXPECT_LE(map[1], 1);
}

TEST(HdrFlip, RefusesMissingChannels) {
  Image noBlue = grey({1});
  noBlue.channels.pop_back();
  EXPECT_THROW((void)hdrFlip(noBlue, grey({1})), SceneError);
}

}  // namespace
}  // namespace importon::hdr_flip_test
