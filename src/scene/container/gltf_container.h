/// The outermost layer of a glTF file: .glb chunks or plain JSON, checked before any parser sees it.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "scene/container/gltf_source.h"

namespace importon {

/// Views into the file's bytes.
struct GltfContainer {
  bool isBinary = false;
  std::string_view json;
  std::optional<std::span<const std::byte>> binaryChunk;  // of a .glb; holds buffer 0
};

/// Tells .glb from .gltf by its first bytes and checks lengths, chunks and the depth of the JSON. Throws
/// SceneError.
[[nodiscard]] GltfContainer readContainer(std::span<const std::byte> bytes, const GltfSource& source);

}  // namespace importon
