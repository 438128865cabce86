#include "render/film/film.h"

#include <gtest/gtest.h>

namespace importon {
namespace {

/// One pixel: sums over the paths of both halves.
std::vector<FilmPixel> pixelOf(const FilmPixel& even, const FilmPixel& odd) { return {even, odd}; }

FilmPixel sums(float direct, float caustic, float indirect, float square) {
  FilmPixel pixel{};
  pixel.direct = vec3(direct);
  pixel.caustic = vec3(caustic);
  pixel.indirect = vec3(indirect);
  pixel.square = vec3(square);
  return pixel;
}

FilmLayers read(const std::vector<FilmPixel>& halves, std::uint64_t evenSamples, std::uint64_t oddSamples) {
  return resolveFilm(halves, {1, {evenSamples, oddSamples, {}, {}}, false, 1});
}

// 12 paths in the even half, 4 in the odd one: all paths of a pixel weigh the same.
TEST(Film, IsTheMeanOverAllPaths) {
  const FilmLayers layers = read(pixelOf(sums(12, 24, 36, 0), sums(8, 4, 16, 0)), 12, 4);
  EXPECT_FLOAT_EQ(layers.direct[0].x, 20.0f / 16);
  EXPECT_FLOAT_EQ(layers.caustic[0].x, 28.0f / 16);
  EXPECT_FLOAT_EQ(layers.indirect[0].x, 52.0f / 16);
  EXPECT_FLOAT_EQ(layers.total[0].x, 100.0f / 16);
}

/// 3 of 12 and 2 of 4 paths saw the background: 11 of 16 saw a surface.
TEST(Film, CoverageIsTheShareOfPathsThatSawASurface) {
  FilmPixel even = sums(12, 0, 0, 0), odd = sums(4, 0, 0, 0);
  EXPECT_EQ(read(pixelOf(even, odd), 12, 4).coverage[0], 1);
  even.uncovered = 3, odd.uncovered = 2;
  EXPECT_FLOAT_EQ(read(pixelOf(even, odd), 12, 4).coverage[0], 11.0f / 16);
  even.uncovered = 12;
  EXPECT_EQ(read(pixelOf(even, {}), 12, 0).coverage[0], 0);
}

TEST(Film, EmittedLightIsInTheDirectLayer) {
  FilmPixel even = sums(12, 0, 0, 0), odd = sums(4, 0, 0, 0);
  even.emitted = vec3(24), odd.emitted = vec3(8);
  const FilmLayers layers = read(pixelOf(even, odd), 12, 4);
  EXPECT_FLOAT_EQ(layers.direct[0].x, 3);
  EXPECT_FLOAT_EQ(layers.total[0].x, 3);
}

// Even: 12 paths of mean 1 and mean square 12, variance (12 - 1) / 11 = 1 of their mean. Odd: 4 of mean 2 and
// mean square 10, variance (10 - 4) / 3 = 2. The halves weigh 3/4 and 1/4.
TEST(Film, VarianceIsThatOfTheMean) {
  const FilmLayers layers = read(pixelOf(sums(12, 0, 0, 144), sums(8, 0, 0, 40)), 12, 4);
  EXPECT_FLOAT_EQ(layers.variance[0].x, 1 * 9.0f / 16 + 2 * 1.0f / 16);
}

TEST(Film, OfOneHalfIsThatHalf) {
  const FilmLayers layers = read(pixelOf(sums(3, 0, 6, 0), sums(0, 0, 0, 0)), 3, 0);
  EXPECT_FLOAT_EQ(layers.total[0].x, 3);
  EXPECT_EQ(layers.estimatedError, 0);
}

}  // namespace
}  // namespace importon
