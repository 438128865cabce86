#include "scene/container/gltf_resources.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "scene/container/gltf_advice.h"
#include "scene/container/gltf_json.h"
#include "scene/container/meshopt_decode.h"

namespace importon {
namespace {

using Json = nlohmann::json;
using Bytes = std::vector<unsigned char>;

void checkHolds(std::size_t actual, std::size_t needed, const std::string& holder, const std::string& where) {
  if (actual >= needed) return;
  throw SceneError(fmt::format("byteLength is {} but {} holds {} bytes", needed, holder, actual), where,
                   "copy or export the file again; it may be cut off");
}

/// A buffer that names its data.
BufferData readNamed(const Json& buffer, const AssetFolder& folder, const std::string& where, Log& log) {
  const auto byteLength = buffer["byteLength"].get<std::size_t>();
  const auto& uri = buffer["uri"].get_ref<const std::string&>();
  Bytes bytes;
  try {
    bytes = readUri(uri, folder, where + "/uri", log);
  } catch (const MissingFileError& error) {
    return {{}, error};
  }
  checkHolds(bytes.size(), byteLength, isDataUri(uri) ? "the data URI" : fmt::format("'{}'", printable(uri)), where);
  bytes.resize(byteLength);
  return {std::move(bytes), std::nullopt};
}

/// One that does not.
BufferData readUnnamed(const Json& buffer, std::span<const std::byte> binaryChunk, const std::string& where) {
  if (binaryChunk.empty()) return {{}, SceneError("the buffer has neither 'uri' nor a BIN chunk", where, kExportAgain)};
  const auto byteLength = buffer["byteLength"].get<std::size_t>();
  checkHolds(binaryChunk.size(), byteLength, "the BIN chunk of the .glb", where);
  const auto* first = reinterpret_cast<const unsigned char*>(binaryChunk.data());
  return {Bytes(first, first + byteLength), std::nullopt};
}

[[noreturn]] void refuse(UriFault fault, const std::string& uri, const std::string& where) {
  const std::string name = printable(uri);
  switch (fault) {
    case UriFault::empty:
      throw MissingFileError("the URI is empty", where, kExportAgain);
    case UriFault::scheme:
      throw MissingFileError(fmt::format("the URI '{}' begins with a scheme or a drive; only files are read", name),
                             where, "put the file beside the glTF and name it by a relative path");
    case UriFault::nul:
      throw SceneError(fmt::format("the URI '{}' holds a NUL", name), where, kExportAgain);
    default:
      throw SceneError(fmt::format("the URI '{}' leaves the folder of the file", name), where,
                       "put the file beside the glTF and name it by a relative path, or trust the scene and use "
                       "--allow-outside-files");
  }
}

}  // namespace

std::vector<BufferData> readBuffers(const Json& document, std::optional<std::span<const std::byte>> binaryChunk,
                                    const AssetFolder& folder, const GltfSource& source, Log& log) {
  std::vector<BufferData> buffers;
  const Json& array = member(document, "buffers");
  std::span<const std::byte> chunk = binaryChunk.value_or(std::span<const std::byte>());
  for (std::size_t i = 0; i < array.size(); ++i) {
    const std::string where = source.at(fmt::format("/buffers/{}", i));
    if (array[i].contains("uri")) {
      buffers.push_back(readNamed(array[i], folder, where, log));
    } else if (isMeshoptFallback(array[i])) {
      buffers.emplace_back();
    } else {
      buffers.push_back(readUnnamed(array[i], std::exchange(chunk, {}), where));
    }
    if (isMeshoptFallback(array[i])) buffers.back().absence.reset();
  }
  return buffers;
}

std::filesystem::path locateFile(const std::string& uri, const AssetFolder& folder, const std::string& where) {
  if (folder.path.empty()) {
    throw MissingFileError(fmt::format("the file refers to '{}' but is read from memory", printable(uri)), where,
                           "embed buffers and images");
  }
  const UriFile file = resolveUri(folder, uri);
  if (file.fault != UriFault::none) refuse(file.fault, uri, where);
  if (folder.outside == OutsideFiles::refused && leadsOutside(folder.path, file.path)) {
    refuse(UriFault::outside, uri, where);
  }
  std::error_code error;
  if (!std::filesystem::is_regular_file(file.path, error)) {
    throw MissingFileError(fmt::format("the file '{}' is missing", printable(uri)), where, "put it beside the glTF");
  }
  return file.path;
}

Bytes readUri(const std::string& uri, const AssetFolder& folder, const std::string& where, Log& log) {
  if (isDataUri(uri)) {
    std::optional<Bytes> bytes = decodeDataUri(uri);
    if (bytes) return std::move(*bytes);
    throw SceneError(fmt::format("the data URI '{}' is malformed", printable(uri.substr(0, 40))), where, kExportAgain);
  }
  const std::filesystem::path file = locateFile(uri, folder, where);
  if (resolveUri(folder, uri).hadBackslashes) {
    log.warn("backslash in a URI",
             fmt::format("{}: the backslashes of '{}' are taken for slashes", where, printable(uri)));
  }
  return readWholeFile(file, where);
}

Bytes readWholeFile(const std::filesystem::path& file, const std::string& where) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream ? static_cast<std::streamoff>(stream.tellg()) : -1;
  if (size < 0) throw SceneError("the file cannot be read", where, "check its permissions");
  Bytes bytes(static_cast<std::size_t>(size));
  stream.seekg(0);
  if (size > 0 && !stream.read(reinterpret_cast<char*>(bytes.data()), size)) {
    throw SceneError("the file cannot be read to its end", where, "check the disk and copy the file again");
  }
  constexpr std::string_view kLfsPointer = "version https://git-lfs.github.com/spec/";
  const std::string_view head(reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), kLfsPointer.size()));
  if (head == kLfsPointer)
    throw SceneError("the file is a pointer of Git LFS to what was not fetched", where, "run 'git lfs pull'");
  return bytes;
}

}  // namespace importon
