#include "render/film.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace importon {
namespace {

vec3 sumOf(const FilmPixel& p) { return p.direct + p.caustic + p.indirect; }

}  // namespace

Film::Film(gpu::Context& context, std::uint64_t pixels, std::uint64_t tilePixels) : pixels_(pixels) {
  for (std::uint64_t first = 0; first < pixels; first += tilePixels) {
    const std::uint64_t count = std::min(tilePixels, pixels - first);
    FilmTile tile{static_cast<uint>(first), static_cast<uint>(count),
                  gpu::Buffer(context, "film", 2 * count * sizeof(FilmPixel))};
    tile.pixels.upload(std::span<const FilmPixel>(std::vector<FilmPixel>(2 * count)));
    tiles_.push_back(std::move(tile));
  }
}

std::vector<FilmPixel> Film::download() const {
  std::vector<FilmPixel> halves(2 * pixels_);
  for (const FilmTile& tile : tiles_) {
    const std::span<FilmPixel> even(halves.data() + tile.first, tile.count);
    const std::span<FilmPixel> odd(halves.data() + pixels_ + tile.first, tile.count);
    tile.pixels.downloadBytes(std::as_writable_bytes(even), 0);
    tile.pixels.downloadBytes(std::as_writable_bytes(odd), tile.count * sizeof(FilmPixel));
  }
  return halves;
}

FilmLayers resolveFilm(std::span<const FilmPixel> halves, int passes) {
  const std::size_t pixels = halves.size() / 2;
  const float scale = passes > 0 ? 1.0f / static_cast<float>(passes) : 0.0f;
  FilmLayers layers;
  for (auto* layer : {&layers.total, &layers.direct, &layers.caustic, &layers.indirect, &layers.variance})
    layer->resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const FilmPixel &a = halves[i], &b = halves[pixels + i];
    layers.direct[i] = (a.direct + b.direct) * scale;
    layers.caustic[i] = (a.caustic + b.caustic) * scale;
    layers.indirect[i] = (a.indirect + b.indirect) * scale;
    layers.total[i] = layers.direct[i] + layers.caustic[i] + layers.indirect[i];
    const vec3 spread = (a.square + b.square) * scale - layers.total[i] * layers.total[i];
    layers.variance[i] = passes > 1 ? glm::max(spread, vec3(0)) / static_cast<float>(passes - 1) : vec3(0);
  }
  return layers;
}

double estimateError(std::span<const FilmPixel> halves, int passes) {
  const std::size_t pixels = halves.size() / 2;
  const double perHalf = std::max(passes / 2, 1);
  double sum = 0;
  for (const FilmPixel& p : halves) {
    const vec3 s = sumOf(p);
    sum += static_cast<double>(s.x) + static_cast<double>(s.y) + static_cast<double>(s.z);
  }
  const double mean = sum / (static_cast<double>(halves.size()) * 3 * perHalf);
  std::vector<double> errors(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const glm::dvec3 a = glm::dvec3(sumOf(halves[i])) / perHalf, b = glm::dvec3(sumOf(halves[pixels + i])) / perHalf;
    const glm::dvec3 middle = 0.5 * (a + b), half = 0.5 * (a - b);
    const glm::dvec3 relative = half * half / (middle * middle + std::max(0.01 * mean * mean, 1e-300));
    errors[i] = (relative.x + relative.y + relative.z) / 3;
  }
  const std::size_t kept = pixels - pixels / 1000;
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(kept - 1), errors.end());
  const double total = std::accumulate(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(kept), 0.0);
  return std::sqrt(total / static_cast<double>(kept));
}

}  // namespace importon
