/// How many photons a lookup of a map is to have: chosen by what two independent maps show where the camera looks.
#pragma once
#include <span>
#include <vector>

namespace importon {

/// Radiance of the map seen directly, by two independent maps of a pass's photons, looked up with so many.
struct LookupTrial {
  int photons = 0;
  std::vector<float> a, b;  // three channels of each pixel
};

/// What a lookup would err by, relative to the light that is seen, squared.
struct LookupError {
  double variance = 0;  // of one pass
  double bias = 0;      // squared, beyond that of the lookup with fewest photons
};

/// Errors of each trial. `trials` go from few photons to many; the first one's bias counts as none. The variance comes
/// from the difference of the two maps, the bias from what one map differs from the first trial of the other: noise of
/// two maps is independent, so what is left of the mean square is bias.
[[nodiscard]] std::vector<LookupError> lookupErrors(std::span<const LookupTrial> trials);

/// The number of photons with the least error in the mean of `passes` passes.
[[nodiscard]] int chooseLookupPhotons(std::span<const LookupTrial> trials, int passes);

}  // namespace importon
