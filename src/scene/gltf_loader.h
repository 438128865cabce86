/// Reads glTF 2.0 (.gltf, .glb) into a Scene.
#pragma once
#include <cstddef>
#include <filesystem>
#include <span>

#include "base/log.h"
#include "scene/load_options.h"

namespace importon {

/// Loads and validates. Throws SceneError (file, JSON pointer, what, what to do) on anything malformed, on
/// unknown extensionsRequired, when there is no triangle, and when there is no light but should be. Warns once per kind
/// on what is passed over (points, lines, unknown extensionsUsed, degenerate or non-finite triangles, ...).
[[nodiscard]] Scene loadGltf(const std::filesystem::path& file, Log& log, const LoadOptions& options = {});

/// The same from memory, for tests and fuzzing. `folder` says whether files may lie outside it.
[[nodiscard]] Scene loadGltfFromMemory(std::span<const std::byte> bytes, const std::filesystem::path& name,
                                       const AssetFolder& folder, Log& log, const LoadOptions& options = {});

}  // namespace importon
