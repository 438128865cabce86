/// What is known of a lat-long environment map: how much light comes from where.
#pragma once
#include <vector>

#include "scene/scene.h"

namespace importon {

/// Solid angle of a texel of `row`, sr.
[[nodiscard]] double texelSolidAngle(const EnvironmentMap& map, int row);

/// Mean over all directions, W/(m² sr).
[[nodiscard]] vec3 meanRadiance(const EnvironmentMap& map);

/// Densities of drawing directions in each texel by its light, 1/sr; constant over a texel. Radiance is
/// interpolated, so a texel counts its neighbours too, and none that shows light has density 0. All are
/// 1 / (4 pi) for a black map.
[[nodiscard]] std::vector<float> environmentDensities(const EnvironmentMap& map);

/// Throws SceneError at `where` unless the size and all values make sense: some texel, one radiance each, none
/// negative, not finite or so bright that sums overflow.
void checkEnvironment(const EnvironmentMap& map, const std::string& where);

}  // namespace importon
