/// Environment maps from files.
#pragma once
#include <filesystem>
#include <optional>

#include "scene/scene.h"

namespace importon {

/// The lat-long map in channels R, G and B of an OpenEXR file, or in Y; none for an empty name. Throws SceneError.
[[nodiscard]] std::optional<EnvironmentMap> readEnvironmentFile(const std::filesystem::path& file);

}  // namespace importon
