/// The parts of the light that the film has.
#pragma once
#include <array>
#include <span>

#include "render/filter/light_filter.h"
#include "render/plan/sample_counts.h"
#include "shared/render_data.h"

namespace importon {

/// Each of both halves, per pixel: means over paths, W/(m² sr).
struct LightParts {
  LightOfHalves emitted, direct, caustic, indirect;

  [[nodiscard]] std::size_t pixels() const { return emitted.even.size(); }
  [[nodiscard]] LightOfHalves total() const;
};

/// 1 / `samples`, or of none 0.
inline float inverseOf(float samples) { return samples > 0 ? 1 / samples : 0.0f; }

/// `halves` as Film::download gives them.
[[nodiscard]] LightParts readParts(std::span<const FilmPixel> halves, const SampleCounts& counts);

/// Those that are shared among pixels: all but what is emitted by what is seen. Other light than indirect may differ
/// within a pixel: an edge is often one of a shadow, too.
struct SharedPart {
  LightOfHalves LightParts::*part;
  OnEdges onEdges;
};
constexpr std::array kSharedParts{SharedPart{&LightParts::direct, OnEdges::own},
                                  SharedPart{&LightParts::caustic, OnEdges::own},
                                  SharedPart{&LightParts::indirect, OnEdges::mixture}};

[[nodiscard]] LightParts shareLight(LightFilter& filter, const LightParts& raw);

}  // namespace importon
