#include "report/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"

namespace importon::compare_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// One row of grey pixels.
Image grey(const std::vector<float>& values) {
  Image image{static_cast<int>(values.size()), 1, {}, {}};
  for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, values});
  return image;
}

Comparison compare(const Image& image, const Image& reference, std::optional<double> floor = {}) {
  return compareImages(image, "a.exr", reference, "ref.exr", floor);
}

TEST(Compare, FindsNoErrorBetweenEqualImages) {
  const Comparison result = compare(grey({0, 1, 5}), grey({0, 1, 5}));
  EXPECT_EQ(result.relmse, 0);
  EXPECT_EQ(result.relmseTrimmed, 0);
  EXPECT_EQ(result.smape, 0);
  EXPECT_EQ(result.rmse, 0);
  EXPECT_EQ(result.meanRatio, 1);
  EXPECT_EQ(result.flip, 0);
  EXPECT_EQ(result.nonFinitePixels, 0u);
}

// R = (1, 3), mean 2, floor 0.04; I = (2, 3): 1/1.04 and 0.
TEST(Compare, HasTheValuesWorkedByHand) {
  const Comparison result = compare(grey({2, 3}), grey({1, 3}));
  EXPECT_NEAR(result.relmse, 1 / 1.04 / 2, 1e-12);
  EXPECT_NEAR(result.smape, (1.0 / 3) / 2, 1e-12);
  EXPECT_NEAR(result.rmse, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(result.meanRatio, 5.0 / 4, 1e-12);
}

// Only green differs: I = 0.5, R = 1; the others are 1 and 1. Mean 1, floor 0.01.
TEST(Compare, AveragesOverChannels) {
  Image image = grey({1});
  image.channels[1].values = {0.5F};
  const Comparison result = compare(image, grey({1}));
  EXPECT_NEAR(result.relmse, 0.25 / 1.01 / 3, 1e-12);
  EXPECT_NEAR(result.smape, 0.5 / 1.5 / 3, 1e-12);
  EXPECT_NEAR(result.rmse, std::sqrt(0.25 / 3), 1e-12);
  EXPECT_NEAR(result.meanRatio, 2.5 / 3, 1e-12);
}

TEST(Compare, TakesAnAbsoluteFloor) {
  EXPECT_NEAR(compare(grey({2, 3}), grey({1, 3}), 0.01).relmse, 1 / 1.01 / 2, 1e-12);
  EXPECT_NEAR(compare(grey({2, 3}), grey({1, 3}), 0).relmse, 0.5, 1e-12);
}

TEST(Compare, TrimsTheWorstThousandth) {
  std::vector<float> shown(2000, 1), truth(2000, 1);
  shown[7] = 1001;
  shown[1234] = 501;
  shown[1999] = 2;  // two are trimmed, this one stays
  const Comparison result = compare(grey(shown), grey(truth));
  EXPECT_NEAR(result.relmse, (1e6 + 250000 + 1) / 1.01 / 2000, 1e-6);
  EXPECT_NEAR(result.relmseTrimmed, 1 / 1.01 / 1998, 1e-12);
}

TEST(Compare, TrimsNothingFromFewPixels) {
  const Comparison result = compare(grey({2, 3}), grey({1, 3}));
  EXPECT_EQ(result.relmseTrimmed, result.relmse);
}

TEST(Compare, CountsPixelsThatAreNotFinite) {
  const Comparison result = compare(grey({kNan, kInfinity, 4}), grey({1, 1, 2}));
  EXPECT_EQ(result.nonFinitePixels, 2u);
  EXPECT_EQ(result.relmse, static_cast<double>(kInfinity));
  EXPECT_EQ(result.relmseTrimmed, static_cast<double>(kInfinity));
  EXPECT_EQ(result.rmse, static_cast<double>(kInfinity));
  EXPECT_NEAR(result.smape, (1 + 1 + 1.0 / 3) / 3, 1e-12);
  EXPECT_NEAR(result.meanRatio, 2, 1e-12);  // of the third pixel
  EXPECT_GT(result.flip, 2.0 / 3);
  EXPECT_LE(result.flip, 1);
}

TEST(Compare, CountsBrokenPixelsOfTheReferenceToo) {
  const Comparison result = compare(grey({1, 1}), grey({kNan, 1}));
  EXPECT_EQ(result.nonFinitePixels, 1u);
  EXPECT_TRUE(std::isinf(result.relmse));
}

TEST(Compare, IsZeroForTwoBlackImagesAndInfiniteForOne) {
  EXPECT_EQ(compare(grey({0, 0}), grey({0, 0})).relmse, 0);
  EXPECT_EQ(compare(grey({0, 0}), grey({0, 0})).meanRatio, 1);
  EXPECT_TRUE(std::isinf(compare(grey({1, 0}), grey({0, 0})).relmse));
}

// R = (1, 3), floor 0.04; I = (2, 3).
TEST(Compare, TellsWhereTheErrorsAre) {
  ErrorMaps maps;
  const Image image = grey({2, 3}), reference = grey({1, 3});
  const Comparison result = compareImages(image, "a.exr", reference, "ref.exr", {}, &maps);
  ASSERT_EQ(maps.relative.size(), 2u);
  EXPECT_NEAR(maps.relative[0], 1 / 1.04, 1e-6);
  EXPECT_EQ(maps.relative[1], 0);
  EXPECT_NEAR((maps.flip[0] + maps.flip[1]) / 2, result.flip, 1e-6);
  EXPECT_NEAR((maps.flipHdr[0] + maps.flipHdr[1]) / 2, result.flipHdr, 1e-6);
  const Image difference = differenceImage(image, "a.exr", reference, "ref.exr", maps);
  EXPECT_EQ(difference.find("G")->values, (std::vector<float>{1, 0}));
  EXPECT_EQ(difference.find("relative.Y")->values, maps.relative);
  EXPECT_EQ(difference.find("flip_hdr.Y")->values, maps.flipHdr);
}

TEST(Compare, HasTheSameValuesWithoutFlip) {
  const ValueErrors values = compareValues(grey({2, 3}), "a.exr", grey({1, 3}), "ref.exr");
  EXPECT_EQ(values.relmse, compare(grey({2, 3}), grey({1, 3})).relmse);
  EXPECT_EQ(values.meanRatio, 1.25);
}

TEST(Compare, RefusesOtherSizesAndMissingChannels) {
  EXPECT_THROW((void)compare(grey({1, 2}), grey({1})), SceneError);
  Image noBlue = grey({1});
  noBlue.channels.pop_back();
  EXPECT_THROW((void)compare(noBlue, grey({1})), SceneError);
  EXPECT_THROW((void)compare(grey({1}), noBlue), SceneError);
}

}  // namespace
}  // namespace importon::compare_test
