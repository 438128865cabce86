/// External buffers and images, read with precise errors before tinygltf asks for them.
#pragma once
#include <deque>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "scene/container/gltf_source.h"
#include "scene/container/uri.h"

namespace importon {

/// Bytes of the external files, in the order in which tinygltf asks for them: buffers, then images. (By order
/// and not by name, since tinygltf 2.7 decodes the '+' of a URI to a space.)
using GltfResources = std::deque<std::vector<unsigned char>>;

/// Checks every buffer and image and reads the external ones. `binaryChunkBytes` is the size of the .glb's BIN
/// chunk, 0 if there is none. The document has passed checkSchema.
/// Throws SceneError on a missing or short file, a URI that leaves the folder, a malformed data URI, a buffer
/// that is longer than its data.
[[nodiscard]] GltfResources readResources(const nlohmann::json& document, std::size_t binaryChunkBytes,
                                          const AssetFolder& folder, const GltfSource& source);

/// The bytes of a regular file. Throws SceneError; `where` as in SceneError.
[[nodiscard]] std::vector<unsigned char> readWholeFile(const std::filesystem::path& file, const std::string& where);

}  // namespace importon
