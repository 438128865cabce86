#include "render/film/light_parts.h"

namespace importon {

LightOfHalves LightParts::total() const {
  LightOfHalves sum = emitted;
  for (const LightOfHalves* part : {&direct, &caustic, &indirect})
    for (std::size_t i = 0; i < pixels(); ++i) {
      sum.even[i] += part->even[i];
      sum.odd[i] += part->odd[i];
    }
  return sum;
}

LightParts readParts(std::span<const FilmPixel> halves, const SampleCounts& counts) {
  const std::size_t pixels = halves.size() / 2;
  const auto read = [&](vec3 FilmPixel::*light) {
    LightOfHalves means = darkHalves(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
      means.even[i] = halves[i].*light * inverseOf(counts.even(i));
      means.odd[i] = halves[pixels + i].*light * inverseOf(counts.odd(i));
    }
    return means;
  };
  return {read(&FilmPixel::emitted), read(&FilmPixel::direct), read(&FilmPixel::caustic), read(&FilmPixel::indirect)};
}

LightParts shareLight(LightFilter& filter, const LightParts& raw) {
  LightParts shown{raw.emitted, {}, {}, {}};
  for (const auto& [part, onEdges] : kSharedParts) shown.*part = filter.clean(raw.*part, onEdges);
  return shown;
}

}  // namespace importon
