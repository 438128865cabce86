/// Environment maps from files.
#pragma once
#include <filesystem>
#include <optional>

#include "scene/scene.h"

namespace importon {

/// The lat-long map of a Radiance picture, or in channels R, G and B, or Y, of an OpenEXR file; none for an empty name.
/// What the file holds tells which it is. Throws SceneError.
[[nodiscard]] std::optional<EnvironmentMap> readEnvironmentFile(const std::filesystem::path& file);

}  // namespace importon
