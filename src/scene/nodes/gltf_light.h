/// KHR_lights_punctual and the constant environment of scene extras.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/log.h"
#include "scene/container/gltf_document.h"
#include "scene/nodes/gltf_nodes.h"
#include "scene/scene.h"

namespace importon {

/// The lights of `nodes` in render space, world = render + worldFromRender; `sceneRadius` in m gives
/// directional lights their power. Candela and lux are taken as W/sr and W/m². Throws SceneError.
[[nodiscard]] std::vector<Light> readPunctualLights(const GltfDocument& document, std::span<const PlacedNode> nodes,
                                                    const glm::dvec3& worldFromRender, float sceneRadius);

/// Where the node stands and looks, along its -z; its scale has no effect. Throws SceneError.
void placeLight(const glm::dmat4& worldFromLight, const glm::dvec3& worldFromRender, const std::string& where,
                Light& light);

/// extras.environment of the default scene: {"type": "constant", "radiance": [r, g, b]}. Other types are passed
/// over with a warning.
[[nodiscard]] std::optional<EnvironmentMap> readEnvironment(const GltfDocument& document, Log& log);

}  // namespace importon
