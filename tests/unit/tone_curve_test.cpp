#include "io/tone_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace importon::tone_curve_test {
namespace {

constexpr std::array kAll{ToneMap::neutral, ToneMap::agx, ToneMap::aces, ToneMap::none};

void expectColor(ToneMap map, std::array<float, 3> exposed, std::array<float, 3> shown, float tolerance = 1e-5F) {
  const auto found = toneMapped(map, exposed);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], shown[c], tolerance) << c;
}

float grey(ToneMap map, float exposed) { return toneMapped(map, {exposed, exposed, exposed})[1]; }

TEST(ToneCurve, NeutralTakesOffWhatFresnelReflectionAdds) {
  expectColor(ToneMap::neutral, {0.5F, 0.3F, 0.2F}, {0.46F, 0.26F, 0.16F});
  expectColor(ToneMap::neutral, {0.5F, 0.04F, 0.04F}, {0.47F, 0.01F, 0.01F});  // 6.25 x² is left of the least, x
  expectColor(ToneMap::neutral, {0.5F, 0, 0}, {0.5F, 0, 0});
}

/// Worked by hand: a peak of 1.72 becomes 1 - 0.24² / 1.2 = 0.952, and 1 - 1 / 1.1152 of the colour becomes grey.
TEST(ToneCurve, NeutralCompressesThePeakAndTakesSaturationOff) {
  expectColor(ToneMap::neutral, {1.76F, 1.76F, 1.76F}, {0.952F, 0.952F, 0.952F});
  expectColor(ToneMap::neutral, {1.76F, 0.44F, 0.44F}, {0.952F, 0.296867F, 0.296867F});
}

TEST(ToneCurve, NeutralHasNoKinkWhereCompressionStarts) {
  EXPECT_NEAR(grey(ToneMap::neutral, 0.801F) - grey(ToneMap::neutral, 0.8F), 0.001F, 1e-5F);
  EXPECT_NEAR(grey(ToneMap::neutral, 0.0801F) - grey(ToneMap::neutral, 0.08F), 0.0001F, 1e-5F);
}

/// Its matrices keep grey, so that grey is the fit of the curve alone.
TEST(ToneCurve, AcesHasTheValuesOfTheFit) {
  EXPECT_NEAR(grey(ToneMap::aces, 0.18F), 0.105591F, 1e-5F);
  EXPECT_NEAR(grey(ToneMap::aces, 1), 0.619115F, 1e-4F);
  expectColor(ToneMap::aces, {1, 0, 0}, {0.688028F, 0, 0.002639F});
}

/// 0.18 lies ten of 16.5 stops up; the log range ends at 2^-12.47393 and 2^4.026069, where the polynomial has
/// -0.00232 and the sum of its coefficients.
TEST(ToneCurve, AgxHasThePublishedRangeAndPolynomial) {
  EXPECT_NEAR(grey(ToneMap::agx, 0.18F), 0.214519F, 1e-4F);
  EXPECT_EQ(grey(ToneMap::agx, std::exp2(-12.5F)), 0);
  const float most = std::pow(0.99858F, 2.2F);
  EXPECT_NEAR(grey(ToneMap::agx, std::exp2(4.03F)), most, 2e-4F);
  EXPECT_LT(grey(ToneMap::agx, std::exp2(3.0F)), most - 1e-3F);
}

TEST(ToneCurve, AgxBringsBrightColoursTowardsWhite) {
  const auto dim = toneMapped(ToneMap::agx, {0.2F, 0.02F, 0.02F}), bright = toneMapped(ToneMap::agx, {20, 2, 2});
  EXPECT_GT(bright[1] / bright[0], 2 * dim[1] / dim[0]);
}

TEST(ToneCurve, NoneCutsOffWhatIsAboveOne) { expectColor(ToneMap::none, {0.25F, 1, 7}, {0.25F, 1, 1}, 0); }

TEST(ToneCurve, AllKeepGreyGreyAndRiseWithIt) {
  for (const ToneMap map : kAll) {
    float last = -1;
    for (float exposed = 1e-3F; exposed < 100; exposed *= 1.1F) {
      const auto shown = toneMapped(map, {exposed, exposed, exposed});
      const auto [least, most] = std::minmax({shown[0], shown[1], shown[2]});
      EXPECT_NEAR(least, most, 1e-3F) << exposed;
      EXPECT_GE(shown[1], last) << exposed;
      last = shown[1];
    }
  }
}

TEST(ToneCurve, AllTakeAnything) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
  for (const ToneMap map : kAll) {
    for (const float c : toneMapped(map, {kNan, -1, -kInfinity})) EXPECT_NEAR(c, 0, 1e-6F);
    for (const float c : toneMapped(map, {kInfinity, kInfinity, kInfinity})) EXPECT_NEAR(c, 1, 0.01F);
    for (const float c : toneMapped(map, {kInfinity, 0, 1e30F})) EXPECT_TRUE(c >= 0 && c <= 1);
  }
}

}  // namespace
}  // namespace importon::tone_curve_test
