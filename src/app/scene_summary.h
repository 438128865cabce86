/// What `importon info` tells of a scene.
#pragma once
#include <span>
#include <string>

#include "render/features/feature_set.h"
#include "scene/scene.h"

namespace importon {

/// For people.
[[nodiscard]] std::string summaryText(const Scene& scene, std::span<const FeatureRow> features);

/// The same as JSON text. Lengths in metres, angles in radians, positions in the world.
[[nodiscard]] std::string summaryJson(const Scene& scene, std::span<const FeatureRow> features);

}  // namespace importon
