#include "render/film.h"

#include <unistd.h>

#include <algorithm>
#include <cstdint>

#include "base/error.h"
#include "fmt/format.h"
#include "render/error_estimate.h"
#include "render/indirect_filter.h"

namespace importon {
namespace {

/// Bytes that a film may take. A CPU device shares the host's memory, of which drivers may name a part only as theirs.
std::uint64_t memoryFor(const gpu::Limits& limits) {
  if (!limits.isCpu) return limits.heapBytes;
  const long pages = sysconf(_SC_PHYS_PAGES), pageBytes = sysconf(_SC_PAGESIZE);
  return std::max(limits.heapBytes, static_cast<std::uint64_t>(std::max(pages, 0L)) * static_cast<std::uint64_t>(pageBytes));
}

}  // namespace

Film::Film(gpu::Context& context, std::uint64_t pixels, std::uint64_t tilePixels) : pixels_(pixels) {
  // A CPU device shares its memory with the host, which reads the film back and resolves it.
  const std::uint64_t need = 2 * pixels * sizeof(FilmPixel) * (context.limits().isCpu ? 3 : 1);
  const std::uint64_t memory = memoryFor(context.limits());
  if (need > memory)
    throw DeviceError(fmt::format("an image of {} pixels needs {} MiB of memory", pixels, need >> 20),
                      fmt::format("{} has {} MiB", context.info().name, memory >> 20),
                      "lower --width and --height");
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

namespace {

/// Light of both halves as means over their passes.
struct HalfMeans {
  std::vector<vec3> even, odd;
};

HalfMeans indirectMeans(std::span<const FilmPixel> halves, const FilmReading& reading, float perEven, float perOdd) {
  const std::size_t pixels = halves.size() / 2;
  if (reading.filtersIndirect && reading.oddSamples > 0) {
    FilteredIndirect filtered = filterIndirect(halves, {reading.width, reading.evenSamples, reading.oddSamples}, reading.threads);
    return {std::move(filtered.even), std::move(filtered.odd)};
  }
  HalfMeans means{std::vector<vec3>(pixels), std::vector<vec3>(pixels)};
  for (std::size_t i = 0; i < pixels; ++i) {
    means.even[i] = halves[i].indirect * perEven;
    means.odd[i] = halves[pixels + i].indirect * perOdd;
  }
  return means;
}

}  // namespace

FilmLayers resolveFilm(std::span<const FilmPixel> halves, const FilmReading& reading) {
  const std::size_t pixels = halves.size() / 2;
  const std::int64_t samples = reading.evenSamples + reading.oddSamples;
  const auto inverse = [](std::int64_t n) { return n > 0 ? 1.0f / static_cast<float>(n) : 0.0f; };
  const float scale = inverse(samples), perEven = inverse(reading.evenSamples), perOdd = inverse(reading.oddSamples);
  const float evenShare = static_cast<float>(reading.evenSamples) * scale;
  HalfMeans means = indirectMeans(halves, reading, perEven, perOdd);
  HalfMeans raw{std::vector<vec3>(pixels), std::vector<vec3>(pixels)};
  FilmLayers layers;
  for (auto* layer : {&layers.total, &layers.direct, &layers.caustic, &layers.indirect, &layers.variance})
    layer->resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const FilmPixel &a = halves[i], &b = halves[pixels + i];
    layers.direct[i] = (a.direct + b.direct) * scale;
    layers.caustic[i] = (a.caustic + b.caustic) * scale;
    layers.indirect[i] = means.even[i] * evenShare + means.odd[i] * (1 - evenShare);
    layers.total[i] = layers.direct[i] + layers.caustic[i] + layers.indirect[i];
    const vec3 unfiltered = layers.direct[i] + layers.caustic[i] + (a.indirect + b.indirect) * scale;
    const vec3 spread = (a.square + b.square) * scale - unfiltered * unfiltered;
    layers.variance[i] = samples > 1 ? glm::max(spread, vec3(0)) / static_cast<float>(samples - 1) : vec3(0);
    raw.even[i] = (a.direct + a.caustic + a.indirect) * perEven;
    raw.odd[i] = (b.direct + b.caustic + b.indirect) * perOdd;
    means.even[i] += (a.direct + a.caustic) * perEven;
    means.odd[i] += (b.direct + b.caustic) * perOdd;
  }
  layers.error.resize(pixels);
  if (reading.oddSamples == 0) return layers;
  ErrorEstimate estimate = estimateErrors({means.even, means.odd, evenShare}, {raw.even, raw.odd, evenShare}, reading.width);
  layers.estimatedError = estimate.relative;
  layers.error = std::move(estimate.perPixel);
  return layers;
}

}  // namespace importon
