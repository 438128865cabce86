/// What caustics add to the light that is there besides, at places: the more light drowns a caustic, the fewer of its
/// photons are required.
#pragma once
#include <optional>
#include <vector>

#include "render/importance/importance.h"
#include "render/importance/point_density.h"

namespace importon {

/// A photon hit of a pilot.
struct LightPoint {
  vec3 position;           // render space
  float flux = 0;          // W, of a pass, all colours
  bool isCaustic = false;  // of the pilot for the caustic map; else of the one for the global map
};

class LightShare {
 public:
  /// Points lie in the cube of edge `extent` (m) at `origin`.
  LightShare(const std::vector<LightPoint>& points, vec3 origin, float extent);
  /// Share of the caustic in all light at a place, 0 to 1; 1 where no light came.
  [[nodiscard]] double at(vec3 position) const;
  /// Required density there over that of a caustic alone. A caustic of N photons has an error of 1/sqrt(N) of itself;
  /// for the same error of all light, photons go with the square of the caustic's share. At least 1/64.
  [[nodiscard]] double requiredShareAt(vec3 position) const;

 private:
  std::optional<PointDensity> caustic_, all_;  // over the same points, so that they speak for the same cubes
};

/// Scales the required density at each site of the caustic map by the caustic's share.
void scaleByCausticShare(const Stage& stage, ImportanceMap& caustic, const LightShare& share);

}  // namespace importon
