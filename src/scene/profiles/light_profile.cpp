#include "scene/profiles/light_profile.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "scene/lights.h"

namespace importon {
namespace {

constexpr int kRows = 360, kColumns = 360;  // texels

double polarAngle(double row) { return std::min(row / kRows, 1.0) * glm::pi<double>(); }

}  // namespace

LightProfile sampleProfile(const IesProfile& profile) {
  LightProfile result;
  result.width = profile.isAxial() ? 1 : kColumns;
  result.height = kRows;
  std::vector<double> values;
  for (int j = 0; j < result.height; ++j) {
    const double polar = polarAngle(j + 0.5);
    for (int i = 0; i < result.width; ++i) {
      const double azimuth = (i + 0.5) / result.width * glm::two_pi<double>();
      values.push_back(profile.intensity(
          {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), -std::cos(polar)}));
    }
  }
  result.most = *std::ranges::max_element(values);
  if (!(result.most > 0)) return result;
  for (std::size_t k = 0; k < values.size(); ++k) {
    constexpr double kOne = 65535;
    const auto row = static_cast<int>(k) / result.width;
    const auto share = static_cast<uint>(std::lround(values[k] / result.most * kOne));
    result.texels.insert(result.texels.end(), 2, share | share << 16);
    const double band = std::cos(polarAngle(row)) - std::cos(polarAngle(row + 1));
    result.shareIntegral += share / kOne * band * glm::two_pi<double>() / result.width;
    if (share > 0) result.cosOuter = static_cast<float>(std::cos(polarAngle(row + 1.5)));
  }
  return result;
}

Texture textureOf(const LightProfile& profile, uint firstTexel) {
  Texture texture{};
  texture.firstTexel = firstTexel;
  texture.width = static_cast<uint>(profile.width);
  texture.height = static_cast<uint>(profile.height);
  texture.wrapS = kWrapRepeat;
  texture.wrapT = kWrapClamp;
  texture.isDeep = 1;
  texture.uvRow0 = vec3(1, 0, 0);
  texture.uvRow1 = vec3(0, 1, 0);
  return texture;
}

Light lightOf(const LightProfile& profile, uint texture, const vec3& factor) {
  Light light{};
  light.kind = kLightProfile;
  light.triangle = texture;
  light.cosOuter = profile.cosOuter;
  light.emission = factor * static_cast<float>(profile.most);
  light.power = profilePower(light.emission, profile.shareIntegral);
  return light;
}

}  // namespace importon
