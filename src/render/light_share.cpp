#include "render/light_share.h"

#include <algorithm>

namespace importon {
namespace {
constexpr double kLeastShare = 1.0 / 64;
}

LightShare::LightShare(const std::vector<LightPoint>& points, vec3 origin, float extent) {
  std::vector<vec3> positions;
  std::vector<float> caustic, all;
  for (const LightPoint& point : points) {
    positions.push_back(point.position);
    caustic.push_back(point.isCaustic ? point.flux : 0);
    all.push_back(point.isCaustic ? 0 : point.flux);  // caustics are in the global map too
  }
  caustic_.emplace(positions, caustic, origin, extent);
  all_.emplace(positions, all, origin, extent);
}

double LightShare::at(vec3 position) const {
  const double caustic = caustic_->at(position), all = std::max(all_->at(position), caustic);
  return all > 0 ? caustic / all : 1;
}

double LightShare::requiredShareAt(vec3 position) const {
  const double share = at(position);
  return std::max(share * share, kLeastShare);
}

}  // namespace importon
