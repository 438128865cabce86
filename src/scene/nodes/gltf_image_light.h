/// Light from pictures: EXT_lights_image_based, and of the draft KHR_lights_environment what is like it.
#pragma once
#include <optional>

#include "base/log.h"
#include "scene/container/gltf_document.h"
#include "scene/scene.h"

namespace importon {

/// The image-based light of the scene that is shown, as an environment map: the first cube of its specularImages, which
/// is not blurred, or, without images, what its irradianceCoefficients tell. Values times intensity are taken as W/(m²
/// sr). The other cubes are not needed: blur comes from the materials. Throws SceneError.
[[nodiscard]] std::optional<EnvironmentMap> readImageLight(const GltfDocument& document, Log& log);

}  // namespace importon
