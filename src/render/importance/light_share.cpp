#include "render/importance/light_share.h"

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

void scaleByCausticShare(const Stage& stage, ImportanceMap& caustic, const LightShare& share) {
  const gpu::Buffer& known = caustic.bound ? caustic.bound : caustic.importance;
  std::vector<float> required = known.download<float>(caustic.sites());
  const std::vector<MapPoint> sites = caustic.readPoints();
  for (std::size_t i = 0; i < required.size(); ++i)
    required[i] *= static_cast<float>(share.requiredShareAt(sites[i].position));
  caustic.bound =
      gpu::makeBuffer(stage.gpu, "required by other light", std::span<const float>(required), gpu::TexelFormat::float1);
}

}  // namespace importon
