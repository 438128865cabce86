/// Shares gathered irradiance among neighbouring pixels that see the same surface.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "render/film/adaptive_sampler.h"

namespace importon {

/// Filtered indirect light of both halves, with its modulation, per pixel: means over passes.
struct FilteredIndirect {
  std::vector<vec3> even, odd;
};

/// Averages irradiance (indirect light over its modulation) over discs of pixels whose gathers lie on the same plane
/// with like normals. The radius of each pixel, from 0 on, is the one whose disc in the one half predicts the other
/// half best over a window around it, errors taken relative to radiance as in relMSE: noise lowers with the radius,
/// bias rises, and as the noise goes to zero so does the radius. Direct and caustic light are untouched. `halves`: even
/// passes, then odd ones, each width · height pixels; at least a sample in each half.
[[nodiscard]] FilteredIndirect filterIndirect(std::span<const FilmPixel> halves, int width, const SampleCounts& counts,
                                              int threads);

}  // namespace importon
