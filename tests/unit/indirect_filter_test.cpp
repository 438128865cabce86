#include "render/film/indirect_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace importon::indirect_filter_test {
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
    film[i].gathers = 4;
  }
  return film;
}

Seen onFloor(int x, int y) { return {vec3(x, 0, y), vec3(0, 1, 0), 1, (x / 3 + y / 3) % 2 == 0 ? 0.2f : 0.8f}; }

/// Of the image of both halves over irradiance 1, root mean square over pixels that `counts`.
double errorOf(const FilteredIndirect& image, const std::function<Seen(int, int)>& seen,
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

TEST(IndirectFilter, LowersNoiseOnAPlaneAndKeepsItsTextures) {
  const double error = errorOf(filterIndirect(filmOf(onFloor, 0.2f), kWidth, kFourPaths, 1), onFloor, everywhere);
  // 0.2 / sqrt(2) without it. Larger discs predict the other half hardly better than one of radius 5, 81 pixels.
  EXPECT_LT(error, 0.2 / std::sqrt(2.0) / 9);
}

TEST(IndirectFilter, LeavesLightWithoutNoiseAsItIs) {
  const auto floor = [](int x, int y) {
    Seen s = onFloor(x, y);
    s.irradiance = 1 + std::sin(0.5f * static_cast<float>(x));
    return s;
  };
  EXPECT_LT(errorOf(filterIndirect(filmOf(floor, 0), kWidth, kFourPaths, 1), floor, everywhere), 1e-6);
}

TEST(IndirectFilter, SharesNothingBetweenSurfaces) {
  // A floor, a wall that leans by 30 degrees, and a floor below: each of an irradiance of its own.
  const auto scene = [](int x, int y) {
    Seen s = onFloor(x, y);
    if (x >= 20)
      s = {vec3(x, 0.577f * static_cast<float>(x - 20), y), glm::normalize(vec3(-0.577f, 1, 0)), 3, s.albedo};
    if (x >= 35) s = {vec3(x, -20, y), vec3(0, 1, 0), 9, s.albedo};
    return s;
  };
  const FilteredIndirect image = filterIndirect(filmOf(scene, 0.01f), kWidth, kFourPaths, 1);
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
  const FilteredIndirect image = filterIndirect(film, kWidth, kFourPaths, 1);
  EXPECT_LT(errorOf(image, scene, isFloor), 1e-6);
  const double error = errorOf(image, scene, [&](int x, int y) { return !isFloor(x, y); });
  EXPECT_LT(error, 1.2 * 0.5 / std::sqrt(2.0) / 5) << "little is shared";
}

TEST(IndirectFilter, SharesNothingBetweenNormalsThatDifferInOnePlane) {
  expectSharesNothing([](int x, int y) { return Seen{vec3(x, 0, y), vec3(0, -1, 0), 1, 0.5f}; });
  // Pixels side by side lie in the planes of both.
  expectSharesNothing([](int x, int y) { return Seen{vec3(x, 0, y), glm::normalize(vec3(0, 1, 0.577f)), 1, 0.5f}; });
}

TEST(IndirectFilter, SharesNothingBetweenParallelPlanes) {
  // Further apart than a tenth of the largest disc's radius of 15.
  for (const float depth : {2.0f, 20.0f})
    expectSharesNothing([depth](int x, int y) { return Seen{vec3(x, -depth, y), vec3(0, 1, 0), 1, 0.5f}; });
}

TEST(IndirectFilter, TakesForNoiseWhatTheOtherHalfDoesNotShow) {
  std::vector<FilmPixel> film = filmOf(onFloor, 0.2f);
  const auto evenError = [&] {
    double sum = 0;
    const FilteredIndirect image = filterIndirect(film, kWidth, kFourPaths, 1);
    for (std::size_t i = 0; i < kPixels; ++i)
      sum += std::pow(static_cast<double>(4 * image.even[i].x / film[i].modulation.x) - 1, 2);
    return std::sqrt(sum / static_cast<double>(kPixels));
  };
  for (std::size_t i = kPixels; i < film.size(); ++i) film[i].indirect = film[i].modulation;  // the odd half has none
  EXPECT_LT(evenError(), 0.2 / 9);
  std::copy_n(film.begin(), kPixels, film.begin() + kPixels);  // it has the same: a pattern of the light
  EXPECT_GT(evenError(), 0.19);
}

TEST(IndirectFilter, SharesEdgesWithEdgesOnly) {
  // Every fifth column sees two surfaces and twice the light.
  const auto scene = [](int x, int y) {
    Seen s = onFloor(x, y);
    if (x % 5 == 0) s.normal = vec3(0.5f, 0.5f, 0), s.irradiance = 2;
    return s;
  };
  const FilteredIndirect image = filterIndirect(filmOf(scene, 0.2f), kWidth, kFourPaths, 1);
  const auto isEdge = [](int x, int) { return x % 5 == 0; };
  // Discs of radius 4 hold nine pixels of the column.
  const double edges = errorOf(image, scene, isEdge);
  EXPECT_LT(edges, 2 * 0.2 / std::sqrt(2.0) / 2);
  EXPECT_GT(edges, 2 * 0.2 / std::sqrt(2.0) / 4);
  EXPECT_LT(errorOf(image, scene, [&](int x, int y) { return !isEdge(x, y); }), 0.2 / std::sqrt(2.0) / 9);
}

TEST(IndirectFilter, WeighsErrorsAsTheImageShowsThem) {
  // A dark floor with a fine pattern beside a bright wall with noise: what the wall gains does not blur the floor.
  const auto scene = [](int x, int y) {
    Seen s = onFloor(x, y);
    s.albedo = 0.5f;
    s.irradiance = (x + y) % 2 == 0 ? 50 : 150;
    if (x >= kWidth / 2) s = {s.position, vec3(1, 0, 0), 10000, s.albedo};
    return s;
  };
  const FilteredIndirect image = filterIndirect(filmOf(scene, 0.05f), kWidth, kFourPaths, 1);
  const double error = errorOf(image, scene, [](int x, int) { return x < kWidth / 2 && x >= kWidth / 2 - 3; });
  EXPECT_LT(error, 50.0 / 4);
}

TEST(IndirectFilter, PixelsWithoutGathersKeepTheirLight) {
  std::vector<FilmPixel> film = filmOf(onFloor, 0.2f);
  for (std::size_t i = 0; i < film.size(); i += 3) film[i].gathers = 0;
  const FilteredIndirect image = filterIndirect(film, kWidth, kFourPaths, 1);
  for (std::size_t i = 0; i < kPixels; i += 3) EXPECT_EQ(image.even[i], film[i].indirect / 4.0f);
}

TEST(IndirectFilter, GivesTheSameBitsOnAnyNumberOfThreads) {
  const std::vector<FilmPixel> film = filmOf(onFloor, 0.3f);
  const FilteredIndirect one = filterIndirect(film, kWidth, kFourPaths, 1),
                         three = filterIndirect(film, kWidth, kFourPaths, 3);
  EXPECT_EQ(one.even, three.even);
  EXPECT_EQ(one.odd, three.odd);
}

}  // namespace
}  // namespace importon::indirect_filter_test
