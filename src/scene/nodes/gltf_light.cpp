#include "scene/nodes/gltf_light.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "base/error.h"
#include "scene/container/gltf_advice.h"
#include "scene/container/gltf_json.h"
#include "scene/lights.h"

namespace importon {
namespace {

/// The cosines of the cone, apart by at least what a float can divide by. Angles that are out of order make the
/// sharpest cone that they allow.
void setCone(const tinygltf::Light& source, const std::string& pointer, const GltfDocument& document, Light& light) {
  const double inner = source.spot.innerConeAngle;
  const double outer = source.spot.outerConeAngle;
  const std::string what = fmt::format("cone angles {} and {} are not 0 <= inner <= outer <= pi/2", inner, outer);
  if (!(outer > 0)) throw SceneError(what, document.source.at(pointer), kExportAgain);
  if (inner > outer || outer > glm::half_pi<double>() + 1e-6) {
    document.faults.forgive("cone angles out of order", pointer, what, "they are clamped to it");
  }
  constexpr double kLeastGap = 1e-6;
  const double cosOuter = std::cos(std::min(outer, glm::half_pi<double>() + 1e-6));
  light.cosOuter = static_cast<float>(std::min(cosOuter, 1.0 - kLeastGap));
  light.cosInner = std::max(static_cast<float>(std::cos(inner)), light.cosOuter + static_cast<float>(kLeastGap));
}

Light readLight(const GltfDocument& document, std::size_t index, float sceneRadius) {
  const tinygltf::Light& source = document.model.lights[index];
  Light light{};
  light.triangle = kNone;
  vec3 color(1.0f);
  for (std::size_t c = 0; c < source.color.size(); ++c) color[static_cast<int>(c)] = toFloat(source.color[c]);
  light.emission = color * toFloat(source.intensity);
  if (source.type == "point") {
    light.kind = kLightPoint;
    light.power = pointPower(light.emission);
  } else if (source.type == "spot") {
    light.kind = kLightSpot;
    setCone(source, fmt::format("/extensions/KHR_lights_punctual/lights/{}", index), document, light);
    light.power = spotPower(light.emission, light.cosInner, light.cosOuter);
  } else if (source.type == "directional") {
    light.kind = kLightDirectional;
    light.power = directionalPower(light.emission, sceneRadius);
  }
  return light;
}

}  // namespace

void placeLight(const glm::dmat4& worldFromLight, const glm::dvec3& worldFromRender, const std::string& where,
                Light& light) {
  light.position = vec3(glm::dvec3(worldFromLight[3]) - worldFromRender);
  const glm::dvec3 direction = -glm::dvec3(worldFromLight[2]);
  const double length = glm::length(direction);
  const bool isFinite =
      std::isfinite(light.position.x) && std::isfinite(light.position.y) && std::isfinite(light.position.z);
  if (!isFinite || !(length > 0) || !std::isfinite(length)) {
    throw SceneError("the transform of the light is not finite, or has scale 0", where, kExportAgain);
  }
  light.direction = vec3(direction / length);
}

std::vector<Light> readPunctualLights(const GltfDocument& document, std::span<const PlacedNode> nodes,
                                      const glm::dvec3& worldFromRender, float sceneRadius) {
  std::vector<Light> lights;
  const nlohmann::json& jsonNodes = member(document.json, "nodes");
  for (const PlacedNode& placed : nodes) {
    const nlohmann::json& use = member(element(jsonNodes, placed.node), "extensions", "KHR_lights_punctual");
    const int index = integerOr(use, "light", -1);
    if (index < 0 || placed.isHidden) continue;
    Light light = readLight(document, static_cast<std::size_t>(index), sceneRadius);
    placeLight(placed.worldFromObject, worldFromRender, document.source.at(fmt::format("/nodes/{}", placed.node)),
               light);
    if (light.power > 0) lights.push_back(light);
  }
  return lights;
}

std::optional<EnvironmentMap> readEnvironment(const GltfDocument& document, Log& log) {
  const std::size_t scene = defaultScene(document);
  const nlohmann::json& extras = member(element(member(document.json, "scenes"), scene), "extras");
  const nlohmann::json& environment = member(extras, "environment");
  if (!environment.is_object()) return std::nullopt;
  const std::string where = document.source.at(fmt::format("/scenes/{}/extras/environment", scene));
  const std::string type = stringOr(environment, "type", "");
  if (type != "constant") {
    log.warn("unknown environment",
             fmt::format("{}: the environment type '{}' is passed over", where, printable(type)));
    return std::nullopt;
  }
  if (!environment.contains("radiance")) {
    throw SceneError("a constant environment needs 'radiance'", where, "add \"radiance\": [r, g, b]");
  }
  return EnvironmentMap{1, 1, {vectorOr<3>(environment, "radiance", vec3(0.0f))}};
}

}  // namespace importon
