#include "render/film/film.h"

#include <unistd.h>

#include <algorithm>
#include <cstdint>

#include "base/error.h"
#include "fmt/format.h"
#include "render/film/error_estimate.h"
#include "render/filter/light_filter.h"

namespace importon {
namespace {

/// Bytes that a film may take. A CPU device shares the host's memory, of which drivers may name a part only as theirs.
std::uint64_t memoryFor(const gpu::Limits& limits) {
  if (!limits.isCpu) return limits.heapBytes;
  const long pages = sysconf(_SC_PHYS_PAGES), pageBytes = sysconf(_SC_PAGESIZE);
  return std::max(limits.heapBytes,
                  static_cast<std::uint64_t>(std::max(pages, 0L)) * static_cast<std::uint64_t>(pageBytes));
}

}  // namespace

Film::Film(gpu::Context& context, std::uint64_t pixels, std::uint64_t tilePixels) : pixels_(pixels) {
  // A CPU device shares its memory with the host, which reads the film back and resolves it.
  const std::uint64_t need = 2 * pixels * sizeof(FilmPixel) * (context.limits().isCpu ? 3 : 1);
  const std::uint64_t memory = memoryFor(context.limits());
  if (need > memory)
    throw DeviceError(fmt::format("an image of {} pixels needs {} MiB of memory", pixels, need >> 20),
                      fmt::format("{} has {} MiB", context.info().name, memory >> 20), "lower --width and --height");
  for (std::uint64_t first = 0; first < pixels; first += tilePixels) {
    const std::uint64_t count = std::min(tilePixels, pixels - first);
    tiles_.push_back({static_cast<uint>(first), static_cast<uint>(count),
                      gpu::makeZeros(context, "film", 2 * count * sizeof(FilmPixel))});
  }
}

LargeVector<FilmPixel> Film::download() const {
  LargeVector<FilmPixel> halves(2 * pixels_);
  for (const FilmTile& tile : tiles_) {
    const std::span<FilmPixel> even(halves.data() + tile.first, tile.count);
    const std::span<FilmPixel> odd(halves.data() + pixels_ + tile.first, tile.count);
    tile.pixels.downloadBytes(std::as_writable_bytes(even), 0);
    tile.pixels.downloadBytes(std::as_writable_bytes(odd), tile.count * sizeof(FilmPixel));
  }
  return halves;
}

namespace {

/// True over estimated error of shared light, in the mean over the renders of tests/calibration: what is light is
/// chosen by the same halves, which keep the noise that they agree on by chance and so differ by less.
constexpr double kChosenByItself = 1.35;

/// Paths of a pixel, of a film that has one half only, up to which light is shared by the colours of a chessboard. With
/// more the noise is less than what that blurs.
constexpr std::uint64_t kFewPaths = 16;

bool hasHalves(const FilmReading& reading) { return reading.sharesLight && reading.counts.oddSamples > 0; }

float inverse(float samples) { return samples > 0 ? 1 / samples : 0.0f; }

/// The parts of a pixel's light, each in both halves, as means over their paths.
struct LightParts {
  LightOfHalves direct, caustic, indirect;
};

LightOfHalves meansOf(std::span<const FilmPixel> halves, const SampleCounts& counts, vec3 FilmPixel::*light) {
  const std::size_t pixels = halves.size() / 2;
  LightOfHalves means{std::vector<vec3>(pixels), std::vector<vec3>(pixels)};
  for (std::size_t i = 0; i < pixels; ++i) {
    means.even[i] = halves[i].*light * inverse(counts.even(i));
    means.odd[i] = halves[pixels + i].*light * inverse(counts.odd(i));
  }
  return means;
}

LightParts cleanAll(LightFilter& filter) {
  return {filter.clean(&FilmPixel::direct), filter.clean(&FilmPixel::caustic), filter.clean(&FilmPixel::indirect)};
}

/// Of a film without odd passes, for which the image stands, too.
LightParts cleanSingleHalf(std::span<const FilmPixel> halves, const FilmReading& reading) {
  const std::span<const FilmPixel> even = halves.first(halves.size() / 2);
  LargeVector<FilmPixel> twice(even.begin(), even.end());
  twice.insert(twice.end(), even.begin(), even.end());
  const SampleCounts& counts = reading.counts;
  LightFilter filter(twice, reading.width, {counts.evenSamples, counts.evenSamples, counts.evenExtra, counts.evenExtra},
                     reading.threads, HalvesBy::chessboard);
  LightParts parts = cleanAll(filter);
  for (LightOfHalves* part : {&parts.direct, &parts.caustic, &parts.indirect})
    for (std::size_t i = 0; i < even.size(); ++i) part->even[i] = part->odd[i] = 0.5f * (part->even[i] + part->odd[i]);
  return parts;
}

LightParts readParts(std::span<const FilmPixel> halves, const FilmReading& reading) {
  if (hasHalves(reading)) {
    LightFilter filter(halves, reading.width, reading.counts, reading.threads);
    return cleanAll(filter);
  }
  if (reading.sharesLight && reading.counts.evenSamples <= kFewPaths) return cleanSingleHalf(halves, reading);
  const auto read = [&](vec3 FilmPixel::*light) { return meansOf(halves, reading.counts, light); };
  return {read(&FilmPixel::direct), read(&FilmPixel::caustic), read(&FilmPixel::indirect)};
}

/// Of the mean of a half's paths.
vec3 varianceOf(const FilmPixel& sums, float samples) {
  if (samples < 2) return vec3(0);
  const vec3 mean = (sums.emitted + sums.direct + sums.caustic + sums.indirect) / samples;
  return glm::max(sums.square / samples - mean * mean, vec3(0)) / (samples - 1);
}

}  // namespace

FilmLayers resolveFilm(std::span<const FilmPixel> halves, const FilmReading& reading) {
  const std::size_t pixels = halves.size() / 2;
  const SampleCounts& counts = reading.counts;
  const float share = counts.evenShare();
  const auto mix = [share](const vec3& even, const vec3& odd) { return even * share + odd * (1 - share); };
  const LightParts parts = readParts(halves, reading);
  LightOfHalves shown{std::vector<vec3>(pixels), std::vector<vec3>(pixels)}, raw = shown;
  FilmLayers layers;
  for (auto* layer : {&layers.total, &layers.direct, &layers.caustic, &layers.indirect, &layers.variance})
    layer->resize(pixels);
  layers.coverage.resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const FilmPixel &a = halves[i], &b = halves[pixels + i];
    const vec3 emittedEven = a.emitted * inverse(counts.even(i)), emittedOdd = b.emitted * inverse(counts.odd(i));
    layers.direct[i] = mix(emittedEven + parts.direct.even[i], emittedOdd + parts.direct.odd[i]);
    layers.caustic[i] = mix(parts.caustic.even[i], parts.caustic.odd[i]);
    layers.indirect[i] = mix(parts.indirect.even[i], parts.indirect.odd[i]);
    layers.total[i] = layers.direct[i] + layers.caustic[i] + layers.indirect[i];
    layers.coverage[i] =
        1 - (a.uncovered * inverse(counts.even(i)) * share + b.uncovered * inverse(counts.odd(i)) * (1 - share));
    layers.variance[i] =
        varianceOf(a, counts.even(i)) * (share * share) + varianceOf(b, counts.odd(i)) * ((1 - share) * (1 - share));
    raw.even[i] = emittedEven + (a.direct + a.caustic + a.indirect) * inverse(counts.even(i));
    raw.odd[i] = emittedOdd + (b.direct + b.caustic + b.indirect) * inverse(counts.odd(i));
    shown.even[i] = emittedEven + parts.direct.even[i] + parts.caustic.even[i] + parts.indirect.even[i];
    shown.odd[i] = emittedOdd + parts.direct.odd[i] + parts.caustic.odd[i] + parts.indirect.odd[i];
  }
  layers.error.resize(pixels);
  if (counts.oddSamples == 0) return layers;
  const ErrorEstimate estimate =
      estimateErrors({shown.even, shown.odd, share}, {raw.even, raw.odd, share}, reading.width);
  const double chosen = hasHalves(reading) ? kChosenByItself : 1;
  layers.estimatedError = chosen * estimate.relative;
  std::transform(estimate.perPixel.begin(), estimate.perPixel.end(), layers.error.begin(),
                 [&](const vec3& error) { return static_cast<float>(chosen) * error; });
  return layers;
}

}  // namespace importon
