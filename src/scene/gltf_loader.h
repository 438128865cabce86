/// Reads glTF 2.0 (.gltf, .glb) into a Scene.
#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>

#include "base/log.h"
#include "scene/container/uri.h"
#include "scene/scene.h"

namespace importon {

/// Loads and validates. Throws SceneError (file, JSON pointer, what, what to do) on anything malformed, on
/// unknown extensionsRequired, and when there is no triangle or no light. Warns once per kind on what is
/// passed over (points, lines, unknown extensionsUsed, degenerate or non-finite triangles, ...). `environment`
/// stands in for the file's own. `outside`: whether buffers and images may lie outside the file's folder.
[[nodiscard]] Scene loadGltf(const std::filesystem::path& file, Log& log,
                             std::optional<EnvironmentMap> environment = std::nullopt,
                             OutsideFiles outside = OutsideFiles::refused);

/// The same from memory, for tests and fuzzing.
[[nodiscard]] Scene loadGltfFromMemory(std::span<const std::byte> bytes, const std::filesystem::path& name,
                                       const AssetFolder& folder, Log& log,
                                       std::optional<EnvironmentMap> environment = std::nullopt);

}  // namespace importon
