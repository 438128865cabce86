#include "render/film/film_sums.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/parallel.h"

namespace importon {
namespace {

constexpr std::array kColors{&FilmPixel::emitted,  &FilmPixel::direct,         &FilmPixel::caustic,
                             &FilmPixel::indirect, &FilmPixel::modulation,     &FilmPixel::position,
                             &FilmPixel::normal,   &FilmPixel::sharedPosition, &FilmPixel::sharedNormal,
                             &FilmPixel::square};
constexpr std::array kNumbers{&FilmPixel::gathers, &FilmPixel::foundSquare, &FilmPixel::uncovered};
static_assert(sizeof(FilmPixel) == kColors.size() * sizeof(vec3) + kNumbers.size() * sizeof(float));

void addPixel(FilmPixel& sum, const FilmPixel& other) {
  for (vec3 FilmPixel::*color : kColors) sum.*color += other.*color;
  for (float FilmPixel::*number : kNumbers) sum.*number += other.*number;
}

void addExtra(std::vector<std::int32_t>& sum, const std::vector<std::int32_t>& other) {
  sum.resize(std::max(sum.size(), other.size()));
  for (std::size_t i = 0; i < other.size(); ++i) sum[i] += other[i];
}

}  // namespace

void FilmSums::swapHalves() {
  const auto middle = halves.begin() + static_cast<std::ptrdiff_t>(halves.size() / 2);
  std::swap_ranges(halves.begin(), middle, middle);
  std::swap(evenSamples, oddSamples);
  std::swap(evenExtra, oddExtra);
}

void FilmSums::add(const FilmSums& other, int threads) {
  constexpr std::size_t kGrain = 1u << 14;
  parallelFor(halves.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) addPixel(halves[i], other.halves[i]);
  });
  evenSamples += other.evenSamples;
  oddSamples += other.oddSamples;
  addExtra(evenExtra, other.evenExtra);
  addExtra(oddExtra, other.oddExtra);
  passes += other.passes;
  seeds.insert(seeds.end(), other.seeds.begin(), other.seeds.end());
}

}  // namespace importon
