#include "render/film/film.h"

#include <unistd.h>

#include <algorithm>
#include <cstdint>

#include "base/error.h"
#include "fmt/format.h"
#include "render/film/error_estimate.h"
#include "render/film/light_parts.h"
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

LightParts shareHalves(std::span<const FilmPixel> halves, const LightParts& raw, const FilmReading& reading) {
  LightFilter filter(halves, reading.width, reading.counts, reading.threads);
  return shareLight(filter, raw);
}

/// Of a film without odd passes, for which the image stands, too.
LightParts shareSingleHalf(std::span<const FilmPixel> halves, const LightParts& raw, const FilmReading& reading) {
  const std::span<const FilmPixel> even = halves.first(halves.size() / 2);
  LargeVector<FilmPixel> twice(even.begin(), even.end());
  twice.insert(twice.end(), even.begin(), even.end());
  const SampleCounts& counts = reading.counts;
  LightFilter filter(twice, reading.width, {counts.evenSamples, counts.evenSamples, counts.evenExtra, counts.evenExtra},
                     reading.threads, HalvesBy::chessboard);
  LightParts shown = raw;
  for (const auto& [part, onEdges] : kSharedParts) {
    shown.*part = filter.clean({(raw.*part).even, (raw.*part).even}, onEdges);
    for (std::size_t i = 0; i < even.size(); ++i)
      (shown.*part).even[i] = 0.5f * ((shown.*part).even[i] + (shown.*part).odd[i]);
  }
  return shown;
}

void setLight(const LightParts& shown, float evenShare, FilmLayers& layers) {
  const auto mean = [evenShare](const LightOfHalves& part, std::size_t i) {
    return part.even[i] * evenShare + part.odd[i] * (1 - evenShare);
  };
  for (auto* layer : {&layers.total, &layers.direct, &layers.caustic, &layers.indirect}) layer->resize(shown.pixels());
  for (std::size_t i = 0; i < shown.pixels(); ++i) {
    layers.direct[i] = (shown.emitted.even[i] + shown.direct.even[i]) * evenShare +
                       (shown.emitted.odd[i] + shown.direct.odd[i]) * (1 - evenShare);
    layers.caustic[i] = mean(shown.caustic, i);
    layers.indirect[i] = mean(shown.indirect, i);
    layers.total[i] = layers.direct[i] + layers.caustic[i] + layers.indirect[i];
  }
}

/// Of the mean of a half's paths.
vec3 varianceOf(const FilmPixel& sums, float samples) {
  if (samples < 2) return vec3(0);
  const vec3 mean = (sums.emitted + sums.direct + sums.caustic + sums.indirect) / samples;
  return glm::max(sums.square / samples - mean * mean, vec3(0)) / (samples - 1);
}

void setVarianceAndCoverage(std::span<const FilmPixel> halves, const SampleCounts& counts, FilmLayers& layers) {
  const std::size_t pixels = halves.size() / 2;
  const float share = counts.evenShare();
  layers.variance.resize(pixels);
  layers.coverage.resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const FilmPixel &a = halves[i], &b = halves[pixels + i];
    const float even = counts.even(i), odd = counts.odd(i);
    layers.variance[i] = varianceOf(a, even) * (share * share) + varianceOf(b, odd) * ((1 - share) * (1 - share));
    layers.coverage[i] = 1 - (a.uncovered * inverseOf(even) * share + b.uncovered * inverseOf(odd) * (1 - share));
  }
}

}  // namespace

FilmLayers resolveFilm(std::span<const FilmPixel> halves, const FilmReading& reading) {
  const SampleCounts& counts = reading.counts;
  const float share = counts.evenShare();
  FilmLayers layers;
  layers.error.resize(halves.size() / 2);
  setVarianceAndCoverage(halves, counts, layers);
  const LightParts raw = readParts(halves, counts);
  if (counts.oddSamples == 0) {
    const bool isShared = reading.sharesLight && counts.evenSamples <= kFewPaths;
    setLight(isShared ? shareSingleHalf(halves, raw, reading) : raw, share, layers);
    return layers;
  }
  const LightParts shown = reading.sharesLight ? shareHalves(halves, raw, reading) : raw;
  setLight(shown, share, layers);
  const LightOfHalves rawTotal = raw.total(), total = shown.total();
  const ErrorEstimate estimate =
      estimateErrors({total.even, total.odd, share}, {rawTotal.even, rawTotal.odd, share}, reading.width);
  const double factor = reading.sharesLight ? kChosenByItself : 1;
  layers.estimatedError = factor * estimate.relative;
  std::transform(estimate.perPixel.begin(), estimate.perPixel.end(), layers.error.begin(),
                 [&](const vec3& error) { return static_cast<float>(factor) * error; });
  return layers;
}

}  // namespace importon
