/// What is known of a lat-long environment map: how much light comes from where.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace importon {

/// Solid angle of a texel of `row`, sr.
[[nodiscard]] double texelSolidAngle(const EnvironmentMap& map, int row);

/// Mean over all directions, W/(m² sr).
[[nodiscard]] vec3 meanRadiance(const EnvironmentMap& map);

/// An entry of a table by which entries are drawn in proportion to weights, in their order: u in [0, 1) stands for the
/// first one whose `end` is more. [Chen and Asau 1974]
struct DrawnEntry {
  std::uint32_t first = 0;  // of n, entry i: the entry that i / n stands for, where the search starts
  float end = 1;            // the sum of weights up to here, over that of all
};

/// Weights that sum up to more than 0.
[[nodiscard]] std::vector<DrawnEntry> inversionTable(std::span<const double> weights);

/// How directions are drawn by light.
struct EnvironmentDraw {
  std::vector<DrawnEntry> entries;  // of the rows, then of the columns of each row
  std::vector<float> densities;     // of each texel, constant over it, 1/sr
};

/// Radiance is interpolated, so a texel counts its neighbours too, and none that shows light has density 0 but what is
/// lost to rounding. All are 1 / (4 pi) for a black map.
[[nodiscard]] EnvironmentDraw drawByLight(const EnvironmentMap& map);

/// Direction of a place in the map, 0 .. 1 from the left and from the top, by lib/environment.glsl.
[[nodiscard]] glm::dvec3 environmentDirection(double x, double y);

/// No radiance of a map is brighter, so that sums stay finite.
inline constexpr double kBrightestEnvironment = 1e12;

/// The map of `height` rows and twice as many columns whose radiance is `radiance(direction)` times `scale`, W/(m² sr)
/// from a direction of unit length, in the mean of 2 x 2 points a texel.
template <class Radiance>
[[nodiscard]] EnvironmentMap mapOf(int height, const Radiance& radiance, double scale = 1) {
  EnvironmentMap map{2 * height, height, {}};
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      glm::dvec3 sum(0.0);
      for (const double below : {0.25, 0.75})
        for (const double beside : {0.25, 0.75})
          sum += radiance(environmentDirection((x + beside) / map.width, (y + below) / map.height));
      map.texels.emplace_back(glm::min(0.25 * scale * sum, glm::dvec3(kBrightestEnvironment)));
    }
  }
  return map;
}

/// The map turned about +y by so many degrees, counter-clockwise seen from above, as a glTF node would turn: by 90,
/// what came from -z comes from -x. Between texels it is interpolated; the light of each row stays the same.
[[nodiscard]] EnvironmentMap turned(const EnvironmentMap& map, double degrees);

/// Throws SceneError at `where` unless the size and all values make sense: some texel, one radiance each, none
/// negative, not finite or so bright that sums overflow.
void checkEnvironment(const EnvironmentMap& map, const std::string& where);

}  // namespace importon
