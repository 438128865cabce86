#include "report/plain_surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace importon {
namespace {

constexpr int kSide = 160;

/// Grey by a function of the pixel.
Image pictureOf(const std::function<double(int, int)>& value) {
  Image image{kSide, kSide, {}, {}};
  std::vector<float> values;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) values.push_back(static_cast<float>(value(x, y)));
  for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, values});
  return image;
}

void addLayer(Image& image, const std::string& name, const std::function<double(int, int)>& value) {
  image.channels.push_back({name, pictureOf(value).channels.front().values});
}

double nothing(int, int) { return 0; }
double one(int, int) { return 1; }

/// A floor to the left of the middle, and a wall to the right.
Image corner() {
  Image image = pictureOf(one);
  const auto isLeft = [](int x, int) { return x < kSide / 2 ? 1.0 : 0.0; };
  const auto isRight = [](int x, int) { return x < kSide / 2 ? 0.0 : 1.0; };
  addLayer(image, "N.X", isRight);
  addLayer(image, "N.Y", isLeft);
  addLayer(image, "N.Z", nothing);
  addLayer(image, "P.X", [](int x, int) { return std::min(x, kSide / 2); });
  addLayer(image, "P.Y", [](int x, int) { return std::max(x - kSide / 2, 0); });
  addLayer(image, "P.Z", [](int, int y) { return y; });
  return image;
}

PlainSurfaces allOf(const Image& image) { return findPlainSurfaces(image, image); }

TEST(PlainSurfaces, AreAllPixelsWithoutLayers) {
  const PlainSurfaces plain = allOf(pictureOf(one));
  EXPECT_FALSE(plain.isKnown);
  EXPECT_EQ(plain.isPlain, std::vector<bool>(kSide * kSide, true));
}

TEST(PlainSurfaces, KeepAwayFromEdges) {
  const PlainSurfaces plain = allOf(corner());
  EXPECT_TRUE(plain.isKnown);
  for (int x = 0; x < kSide; ++x)
    EXPECT_EQ(plain.isPlain[static_cast<std::size_t>(5 * kSide + x)], x < kSide / 2 - 2 || x >= kSide / 2 + 2) << x;
}

TEST(PlainSurfaces, KeepAwayFromShadowsOfDirectLight) {
  Image image = corner();
  for (const char* name : {"direct.R", "direct.G", "direct.B"})
    addLayer(image, name, [](int x, int) { return x < 30 ? 0.5 : 0.0; });
  const PlainSurfaces plain = allOf(image);
  for (int x = 20; x < 40; ++x)
    EXPECT_EQ(plain.isPlain[static_cast<std::size_t>(5 * kSide + x)], x < 28 || x >= 32) << x;
}

TEST(PlainSurfaces, SkyIsNone) {
  Image image = pictureOf(one);
  for (const char* name : {"N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z"}) addLayer(image, name, nothing);
  EXPECT_EQ(allOf(image).isPlain, std::vector<bool>(kSide * kSide, false));
}

// A wave of 20 pixels passes a Gaussian of s pixels by exp(-2 (pi s / 20)^2).
TEST(BandError, OfAWaveIsWhatTheBandPasses) {
  const double amplitude = 0.02;
  const Image truth = pictureOf([](int x, int y) { return 1 + 0.5 * std::sin(0.01 * (x + y)); });
  const auto wave = [&](double length) {
    return pictureOf([&](int x, int y) {
      return (1 + 0.5 * std::sin(0.01 * (x + y))) * std::exp(amplitude * std::cos(2 * M_PI * x / length));
    });
  };
  const auto passed = [](double s, double length) { return std::exp(-2 * std::pow(M_PI * s / length, 2)); };
  const PlainSurfaces plain = allOf(truth);
  const BandError blotch = bandError(wave(20), truth, plain);
  EXPECT_EQ(blotch.pixels, std::uint64_t{kSide} * kSide);
  EXPECT_NEAR(blotch.rms, amplitude * (passed(2, 20) - passed(8, 20)) / std::sqrt(2), 0.02 * amplitude);
  EXPECT_LT(blotch.rms, blotch.p95);
  EXPECT_LT(blotch.p95, blotch.p99);
  EXPECT_LT(bandError(wave(3), truth, plain).rms, 0.02 * amplitude) << "grain is not in the band";
  EXPECT_EQ(bandError(truth, truth, plain).rms, 0);
}

TEST(BandError, LeavesOutWhatIsNotPlainAndWhatIsBlack) {
  const Image truth = pictureOf(one);
  const Image image = pictureOf([](int x, int) { return x < 80 ? 1.0 : x < 120 ? 3.0 : 0.0; });
  PlainSurfaces plain = allOf(truth);
  for (std::size_t i = 0; i < plain.isPlain.size(); ++i) plain.isPlain[i] = i % kSide < 80 || i % kSide >= 120;
  const BandError band = bandError(image, truth, plain);
  EXPECT_EQ(band.rms, 0);
  EXPECT_EQ(band.pixels, 80u * kSide);
}

TEST(GrainRatio, OfWhiteNoiseIsThatOfChance) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const Image noise = pictureOf([&](int, int) { return std::exp(0.02 * normal(random)); });
  EXPECT_NEAR(grainRatio(noise, allOf(noise)), 1.6, 0.1);
}

TEST(GrainRatio, RisesWithSingleSpots) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const Image spots = pictureOf(
      [&](int x, int y) { return std::exp(0.001 * normal(random)) * (x % 20 == 0 && y % 20 == 0 ? 1.2 : 1); });
  EXPECT_GT(grainRatio(spots, allOf(spots)), 10);
  EXPECT_EQ(grainRatio(pictureOf(one), allOf(pictureOf(one))), 0);
}

}  // namespace
}  // namespace importon
