/// The outermost layer of a glTF file: .glb chunks or plain JSON, checked before any parser sees it.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "base/log.h"
#include "scene/container/faults.h"
#include "scene/container/gltf_source.h"

namespace importon {

/// Views into the file's bytes.
struct GltfContainer {
  bool isBinary = false;
  std::string_view json;
  std::optional<std::span<const std::byte>> binaryChunk;  // of a .glb; holds buffer 0
};

/// Tells .glb from .gltf by its first bytes and checks lengths and chunks. Chunks of unknown kind are passed over with
/// a warning. Throws SceneError.
[[nodiscard]] GltfContainer readContainer(std::span<const std::byte> bytes, const GltfSource& source,
                                          const Faults& faults, Log& log);

}  // namespace importon
