/// Buffers and images, in the file itself, in data URIs or in files beside it.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/log.h"
#include "scene/container/gltf_source.h"
#include "scene/container/uri.h"

namespace importon {

/// A URI names no file that is there. Who can do without the file catches this.
class MissingFileError : public SceneError {
 public:
  using SceneError::SceneError;
};

struct BufferData {
  std::vector<unsigned char> bytes;
  std::optional<SceneError> absence;  // why there are none, for who needs them
};

/// The bytes of each buffer, byteLength of them. None where a buffer only stands in for compressed views (`fallback` of
/// EXT_meshopt_compression) and has no data, where its file is missing, or where it names none; the first that names
/// none has `binaryChunk`, of a .glb. The document has passed checkSchema. Throws SceneError on a short file, a URI
/// that may not be read, a malformed data URI, a buffer that is longer than its data.
[[nodiscard]] std::vector<BufferData> readBuffers(const nlohmann::json& document,
                                                  std::optional<std::span<const std::byte>> binaryChunk,
                                                  const AssetFolder& folder, const GltfSource& source, Log& log);

/// The file that `uri`, which is no data URI, names. `where` as in SceneError. Throws MissingFileError, and SceneError
/// where it may not be read.
[[nodiscard]] std::filesystem::path locateFile(const std::string& uri, const AssetFolder& folder,
                                               const std::string& where);

/// The bytes of a data URI or of the file that `uri` names. Warns where it had to be repaired. Throws as locateFile.
[[nodiscard]] std::vector<unsigned char> readUri(const std::string& uri, const AssetFolder& folder,
                                                 const std::string& where, Log& log);

/// The bytes of a regular file. Throws SceneError; `where` as in SceneError.
[[nodiscard]] std::vector<unsigned char> readWholeFile(const std::filesystem::path& file, const std::string& where);

}  // namespace importon
