#include "render/filter/light_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace importon::light_filter_test {
namespace {

constexpr int kWidth = 50, kHeight = 40;
constexpr std::size_t kPixels = std::size_t{kWidth} * kHeight;
constexpr SampleCounts kFourPaths{4, 4, {}, {}};

struct Seen {
  vec3 position, normal;  // normal: mean over a pixel's gathers
  float irradiance, albedo;
};

/// Both halves of a film of four paths per pixel, each of which gathers; irradiance with noise of relative size
/// `noise`.
std::vector<FilmPixel> filmOf(const std::function<Seen(int x, int y)>& seen, float noise) {
  std::mt19937 random(7);
  std::normal_distribution<float> gauss;
  std::vector<FilmPixel> film(2 * kPixels);
  for (std::size_t i = 0; i < film.size(); ++i) {
    const auto pixel = static_cast<int>(i % kPixels);
    const Seen s = seen(pixel % kWidth, pixel / kWidth);
    film[i].indirect = vec3(4 * s.albedo * s.irradiance * (1 + noise * gauss(random)));
    film[i].modulation = vec3(4 * s.albedo);
    film[i].position = 4.0f * s.position;
    film[i].normal = 4.0f * s.normal;
    film[i].sharedPosition = film[i].position;
    film[i].sharedNormal = film[i].normal;
    film[i].gathers = 4;
  }
  return film;
}

Seen onFloor(int x, int y) { return {vec3(x, 0, y), vec3(0, 1, 0), 1, (x / 3 + y / 3) % 2 == 0 ? 0.2f : 0.8f}; }

LightOfHalves read(std::span<const FilmPixel> film, vec3 FilmPixel::*light) {
  LightOfHalves means = darkHalves(kPixels);
  for (std::size_t i = 0; i < kPixels; ++i) {
    means.even[i] = film[i].*light / 4.0f;
    means.odd[i] = film[kPixels + i].*light / 4.0f;
  }
  return means;
}

LightOfHalves filterIndirect(std::span<const FilmPixel> film, int threads = 1) {
  return LightFilter(film, kWidth, kFourPaths, threads).clean(read(film, &FilmPixel::indirect), OnEdges::mixture);
}

/// Of the image of both halves over irradiance 1, root mean square over pixels that `counts`.
double errorOf(const LightOfHalves& image, const std::function<Seen(int, int)>& seen,
               const std::function<bool(int, int)>& counts) {
  double sum = 0, n = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      if (!counts(x, y)) continue;
      const std::size_t i = static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x);
      const Seen s = seen(x, y);
      const double off = static_cast<double>(0.5f * (image.even[i].x + image.odd[i].x) / s.albedo - s.irradiance);
      sum += off * off;
      ++n;
    }
  return std::sqrt(sum / n);
}

bool everywhere(int, int) { return true; }

TEST(LightFilterTest, LowersNoiseOnAPlaneAndKeepsItsTextures) {
  const double error = errorOf(filterIndirect(filmOf(onFloor, 0.2f)), onFloor, everywhere);
  // 0.2 / sqrt(2) without it. The whole floor, 2000 pixels, has 1 / 45 of that.
  EXPECT_LT(error, 0.2 / std::sqrt(2.0) / 20);
}

/// A film of one half, which stands for both.
std::vector<FilmPixel> twice(std::vector<FilmPixel> film) {
  std::copy_n(film.begin(), kPixels, film.begin() + kPixels);
  return film;
}

LightOfHalves filterByChessboard(std::span<const FilmPixel> film) {
  return LightFilter(film, kWidth, kFourPaths, 1, HalvesBy::chessboard)
      .clean(read(film, &FilmPixel::indirect), OnEdges::mixture);
}

TEST(LightFilterTest, OneHalfIsSharedByTheColoursOfAChessboard) {
  const std::vector<FilmPixel> film = twice(filmOf(onFloor, 0.2f));
  EXPECT_GT(errorOf(filterIndirect(film), onFloor, everywhere), 0.19) << "both halves agree on all their noise";
  EXPECT_LT(errorOf(filterByChessboard(film), onFloor, everywhere), 0.2 / 10);
}

TEST(LightFilterTest, AChessboardMixesNoSurfaces) {
  const auto step = [](int x, int y) {
    Seen s = onFloor(x, y);
    if (x >= 20) s = {vec3(x, -20, y), vec3(0, 1, 0), 9, s.albedo};
    return s;
  };
  EXPECT_LT(errorOf(filterByChessboard(twice(filmOf(step, 0))), step, everywhere), 1e-5);
}

TEST(LightFilterTest, LeavesLightWithoutNoiseAsItIs) {
  const auto floor = [](int x, int y) {
    Seen s = onFloor(x, y);
    s.irradiance = 1 + std::sin(0.5f * static_cast<float>(x));
    return s;
  };
  EXPECT_LT(errorOf(filterIndirect(filmOf(floor, 0)), floor, everywhere), 1e-6);
}

TEST(LightFilterTest, SharesNothingBetweenSurfaces) {
  // A floor, a wall that leans by 30 degrees, and a floor below: each of an irradiance of its own.
  const auto scene = [](int x, int y) {
    Seen s = onFloor(x, y);
    if (x >= 20)
      s = {vec3(x, 0.577f * static_cast<float>(x - 20), y), glm::normalize(vec3(-0.577f, 1, 0)), 3, s.albedo};
    if (x >= 35) s = {vec3(x, -20, y), vec3(0, 1, 0), 9, s.albedo};
    return s;
  };
  const LightOfHalves image = filterIndirect(filmOf(scene, 0.01f));
  EXPECT_LT(errorOf(image, scene, everywhere), 0.01 * 9);
}

/// Every other column sees `other`, in light of 1.2 with so much noise that all pixels share their light over large
/// discs. The rest is floor in light of exactly 1, which it keeps if it takes nothing of the other surface.
void expectSharesNothing(const std::function<Seen(int x, int y)>& other) {
  const auto scene = [&](int x, int y) {
    Seen s = onFloor(x, y);
    if (x % 2 != 0) s = other(x, y), s.irradiance = 1.2f;
    return s;
  };
  const auto isFloor = [](int x, int) { return x % 2 == 0; };
  std::vector<FilmPixel> film = filmOf(scene, 0.5f);
  for (std::size_t i = 0; i < film.size(); ++i)
    if (isFloor(static_cast<int>(i % kPixels) % kWidth, 0)) film[i].indirect = film[i].modulation;
  const LightOfHalves image = filterIndirect(film);
  EXPECT_LT(errorOf(image, scene, isFloor), 1e-6);
  const double error = errorOf(image, scene, [&](int x, int y) { return !isFloor(x, y); });
  EXPECT_LT(error, 1.2 * 0.5 / std::sqrt(2.0) / 2.5) << "little is shared";
}

TEST(LightFilterTest, SharesNothingBetweenNormalsThatDifferInOnePlane) {
  expectSharesNothing([](int x, int y) { return Seen{vec3(x, 0, y), vec3(0, -1, 0), 1, 0.5f}; });
  // Pixels side by side lie in the planes of both.
  expectSharesNothing([](int x, int y) { return Seen{vec3(x, 0, y), glm::normalize(vec3(0, 1, 0.577f)), 1, 0.5f}; });
}

TEST(LightFilterTest, SharesNothingBetweenParallelPlanes) {
  // Further apart than a tenth of the largest disc's radius of 15.
  for (const float depth : {2.0f, 20.0f})
    expectSharesNothing([depth](int x, int y) { return Seen{vec3(x, -depth, y), vec3(0, 1, 0), 1, 0.5f}; });
}

TEST(LightFilterTest, TakesForNoiseWhatTheOtherHalfDoesNotShow) {
  std::vector<FilmPixel> film = filmOf(onFloor, 0.2f);
  const auto evenError = [&] {
    double sum = 0;
    const LightOfHalves image = filterIndirect(film);
    for (std::size_t i = 0; i < kPixels; ++i)
      sum += std::pow(static_cast<double>(4 * image.even[i].x / film[i].modulation.x) - 1, 2);
    return std::sqrt(sum / static_cast<double>(kPixels));
  };
  for (std::size_t i = kPixels; i < film.size(); ++i) film[i].indirect = film[i].modulation;  // the odd half has none
  EXPECT_LT(evenError(), 0.2 / 9);
  std::copy_n(film.begin(), kPixels, film.begin() + kPixels);  // it has the same: a pattern of the light
  EXPECT_GT(evenError(), 0.19);
}

TEST(LightFilterTest, SharesEdgesWithEdgesOnly) {
  // Every fifth column sees two surfaces and twice the light.
  const auto scene = [](int x, int y) {
    Seen s = onFloor(x, y);
    if (x % 5 == 0) s.normal = vec3(0.5f, 0.5f, 0), s.irradiance = 2;
    return s;
  };
  const LightOfHalves image = filterIndirect(filmOf(scene, 0.2f));
  const auto isEdge = [](int x, int) { return x % 5 == 0; };
  // Two scales along the column come to a Gaussian of 8 pixels' width.
  const double edges = errorOf(image, scene, isEdge);
  EXPECT_LT(edges, 2 * 0.2 / std::sqrt(2.0) / 1.7);
  EXPECT_GT(edges, 2 * 0.2 / std::sqrt(2.0) / 4);
  EXPECT_LT(errorOf(image, scene, [&](int x, int y) { return !isEdge(x, y); }), 0.2 / std::sqrt(2.0) / 9);
}

/// A floor in light that falls to the right, up to a wall whose light rises with height; in column kCorner both are
/// seen.
constexpr int kCorner = 24;
constexpr float kFloorShare = 0.3f;
Seen atCorner(int x, int y) {
  const auto floor = [&] { return Seen{vec3(x, 0, y), vec3(0, 1, 0), 1 + 0.01f * static_cast<float>(x), 0.2f}; };
  const auto wall = [&] {
    return Seen{vec3(kCorner, x - kCorner, y), vec3(-1, 0, 0), 3 + 0.02f * static_cast<float>(x - kCorner), 0.6f};
  };
  if (x < kCorner) return floor();
  if (x > kCorner) return wall();
  const Seen a = floor(), b = wall();
  const float s = kFloorShare, albedo = s * a.albedo + (1 - s) * b.albedo;
  return {s * a.position + (1 - s) * b.position, s * a.normal + (1 - s) * b.normal,
          (s * a.albedo * a.irradiance + (1 - s) * b.albedo * b.irradiance) / albedo, albedo};
}

TEST(LightFilterTest, PixelsOnACornerAreMixturesOfItsSides) {
  const auto isCorner = [](int x, int) { return x == kCorner; };
  // 0.2 / sqrt(2) of an irradiance of about 2.6 without it.
  EXPECT_LT(errorOf(filterIndirect(filmOf(atCorner, 0.2f)), atCorner, isCorner), 2.6 * 0.2 / std::sqrt(2.0) / 3);
}

// So dim that squares of it are no floats above 0.
TEST(LightFilterTest, LightNextToNothingStaysFinite) {
  std::vector<FilmPixel> film = filmOf(atCorner, 0.2f);
  for (FilmPixel& pixel : film) pixel.indirect *= 1e-24f;
  const LightOfHalves image = filterIndirect(film);
  for (std::size_t i = 0; i < kPixels; ++i) {
    EXPECT_TRUE(std::isfinite(image.even[i].x) && image.even[i].x > 0) << i;
    EXPECT_TRUE(std::isfinite(image.odd[i].x) && image.odd[i].x > 0) << i;
  }
}

TEST(LightFilterTest, CornersKeepLightOfTheirOwn) {
  const auto scene = [](int x, int y) {
    Seen s = atCorner(x, y);
    if (x == kCorner) s.irradiance *= 0.3f;  // a dark gap between floor and wall
    return s;
  };
  const auto isCorner = [](int x, int) { return x == kCorner; };
  const double error = errorOf(filterIndirect(filmOf(scene, 0.05f)), scene, isCorner);
  EXPECT_LT(error, 0.06 * 2.6 * 0.3);
}

TEST(LightFilterTest, AFewBrightSamplesLeaveNoSpots) {
  std::vector<FilmPixel> film = filmOf(onFloor, 0.1f);
  for (const std::size_t i : {std::size_t{20 * kWidth + 25}, kPixels + 10 * kWidth + 12}) film[i].indirect *= 40.0f;
  const LightOfHalves image = filterIndirect(film);
  for (std::size_t i = 0; i < kPixels; ++i) {
    const float shown = 2 * (image.even[i].x + image.odd[i].x) / film[i].modulation.x;
    EXPECT_NEAR(shown, 1, 0.1) << i;
  }
}

TEST(LightFilterTest, LightThatChangesEvenlyKeepsItsSlopeUpToTheBorder) {
  const auto floor = [](int x, int y) {
    Seen s = onFloor(x, y);
    s.irradiance = 1 + 0.05f * static_cast<float>(x);
    return s;
  };
  const LightOfHalves image = filterIndirect(filmOf(floor, 0.2f));
  const double inside = errorOf(image, floor, [](int x, int) { return x > 8 && x < kWidth - 8; });
  const double border = errorOf(image, floor, [](int x, int) { return x < 2; });
  EXPECT_LT(inside, 0.2 / std::sqrt(2.0) * 2.2 / 7);
  EXPECT_LT(border, 0.2 / std::sqrt(2.0) / 2.2);
}

TEST(LightFilterTest, WeighsErrorsAsTheImageShowsThem) {
  // A dark floor with a fine pattern beside a bright wall with noise: what the wall gains does not blur the floor.
  const auto scene = [](int x, int y) {
    Seen s = onFloor(x, y);
    s.albedo = 0.5f;
    s.irradiance = (x + y) % 2 == 0 ? 50 : 150;
    if (x >= kWidth / 2) s = {s.position, vec3(1, 0, 0), 10000, s.albedo};
    return s;
  };
  const LightOfHalves image = filterIndirect(filmOf(scene, 0.05f));
  const double error = errorOf(image, scene, [](int x, int) { return x < kWidth / 2 && x >= kWidth / 2 - 3; });
  EXPECT_LT(error, 50.0 / 4);
}

TEST(LightFilterTest, PixelsWithoutGathersKeepTheirLight) {
  std::vector<FilmPixel> film = filmOf(onFloor, 0.2f);
  for (std::size_t i = 0; i < film.size(); i += 3) film[i].gathers = 0;
  const LightOfHalves image = filterIndirect(film);
  for (std::size_t i = 0; i < kPixels; i += 3) EXPECT_EQ(image.even[i], film[i].indirect / 4.0f);
}

/// Halves of direct light with noise and of indirect light without any, and the reverse.
TEST(LightFilterTest, PartsOfLightAreCleanedEachByItsOwnNoise) {
  std::vector<FilmPixel> film = filmOf(onFloor, 0.2f);
  for (FilmPixel& pixel : film) {
    pixel.direct = pixel.indirect;
    pixel.indirect = pixel.modulation;
  }
  LightFilter filter(film, kWidth, kFourPaths, 1);
  const auto clean = [&](vec3 FilmPixel::*light) { return filter.clean(read(film, light), OnEdges::own); };
  EXPECT_LT(errorOf(clean(&FilmPixel::direct), onFloor, everywhere), 0.2 / std::sqrt(2.0) / 20);
  EXPECT_LT(errorOf(clean(&FilmPixel::indirect), onFloor, everywhere), 1e-6);
  const LightOfHalves caustic = clean(&FilmPixel::caustic);
  for (std::size_t i = 0; i < kPixels; ++i) EXPECT_EQ(caustic.even[i], vec3(0));
}

/// A ball of glass: behind each pixel paths part to two walls by chance, and the light is smooth.
TEST(LightFilterTest, WhatGlassShowsIsSharedOverTheGlass) {
  const auto seen = [](int x, int y) { return Seen{vec3(x, 5, y), vec3(0, 0.5f, 0.5f), 1, 0.5f}; };
  std::vector<FilmPixel> film = filmOf(seen, 0.2f);
  for (std::size_t i = 0; i < film.size(); ++i) {
    const int x = static_cast<int>(i % kPixels) % kWidth, y = static_cast<int>(i % kPixels) / kWidth;
    const vec3 normal = glm::normalize(vec3(x - kWidth / 2, 100, y - kHeight / 2));
    film[i].sharedNormal = 4.0f * normal;
    film[i].sharedPosition = 4.0f * 100.0f * normal;
  }
  EXPECT_LT(errorOf(filterIndirect(film), seen, everywhere), 0.2 / std::sqrt(2.0) / 10);
}

/// Smooth shading leans away from a flat disc, whose pixels share all the same.
TEST(LightFilterTest, ALeaningShadingNormalDoesNotLeaveItsPlane) {
  const auto seen = [](int x, int y) {
    Seen s = onFloor(x, y);
    s.normal = glm::normalize(vec3(0.3f, 1, 0));
    return s;
  };
  std::vector<FilmPixel> film = filmOf(seen, 0.2f);
  for (FilmPixel& pixel : film) pixel.sharedNormal = vec3(0, 4, 0);
  EXPECT_LT(errorOf(filterIndirect(film), seen, everywhere), 0.2 / std::sqrt(2.0) / 20);
}

TEST(LightFilterTest, GivesTheSameBitsOnAnyNumberOfThreads) {
  const std::vector<FilmPixel> film = filmOf(onFloor, 0.3f);
  const LightOfHalves one = filterIndirect(film), three = filterIndirect(film, 3);
  EXPECT_EQ(one.even, three.even);
  EXPECT_EQ(one.odd, three.odd);
}

}  // namespace
}  // namespace importon::light_filter_test
