#include "scene/container/gltf_resources.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "scene/container/gltf_advice.h"
#include "scene/container/uri.h"

namespace importon {
namespace {

using Json = nlohmann::json;

/// The media types that tinygltf 2.7 recognises; it takes any other data URI for a file name.
constexpr std::array<std::string_view, 7> kMediaTypes = {"application/octet-stream",
                                                         "application/gltf-buffer",
                                                         "image/jpeg",
                                                         "image/png",
                                                         "image/bmp",
                                                         "image/gif",
                                                         "text/plain"};

class Reader {
 public:
  Reader(std::size_t binaryChunkBytes, const AssetFolder& folder, const GltfSource& source)
      : binaryChunkBytes_(binaryChunkBytes), folder_(folder), source_(source) {}

  void readBuffer(const Json& buffer, std::size_t index) {
    const std::string where = source_.at(fmt::format("/buffers/{}", index));
    const auto byteLength = buffer["byteLength"].get<std::size_t>();
    if (!buffer.contains("uri")) {
      if (binaryChunkBytes_ == 0) {
        throw SceneError("the buffer has neither 'uri' nor a BIN chunk", where, kExportAgain);
      }
      checkHolds(binaryChunkBytes_, byteLength, "the BIN chunk of the .glb", where);
      return;
    }
    const auto& uri = buffer["uri"].get_ref<const std::string&>();
    if (isDataUri(uri)) {
      const std::size_t bytes = dataUriBytes(uri, where);
      if (bytes == byteLength) return;
      throw SceneError(fmt::format("byteLength is {} but the data URI holds {} bytes", byteLength, bytes), where,
                       kExportAgain);
    }
    std::vector<unsigned char>& bytes = readExternal(uri, where + "/uri");
    checkHolds(bytes.size(), byteLength, fmt::format("'{}'", printable(uri)), where);
    bytes.resize(byteLength);
  }

  void readImage(const Json& image, std::size_t index) {
    const std::string where = source_.at(fmt::format("/images/{}", index));
    const bool hasUri = image.contains("uri");
    if (hasUri == image.contains("bufferView")) {
      throw SceneError("an image needs either 'uri' or 'bufferView'", where, kExportAgain);
    }
    if (!hasUri) return;
    const auto& uri = image["uri"].get_ref<const std::string&>();
    if (!isDataUri(uri)) {
      readExternal(uri, where + "/uri");
    } else if (dataUriBytes(uri, where + "/uri") == 0) {
      throw SceneError("the data URI is empty", where + "/uri", kExportAgain);
    }
  }

  GltfResources take() { return std::move(resources_); }

 private:
  static void checkHolds(std::size_t actual, std::size_t needed, const std::string& holder, const std::string& where) {
    if (actual >= needed) return;
    throw SceneError(fmt::format("byteLength is {} but {} holds {} bytes", needed, holder, actual), where,
                     "copy or export the file again; it may be cut off");
  }

  static std::size_t dataUriBytes(const std::string& uri, const std::string& where) {
    const std::optional<DataUri> data = parseDataUri(uri);
    bool isKnown = false;
    for (const std::string_view type : kMediaTypes) isKnown = isKnown || (data && data->mediaType == type);
    if (!isKnown) {
      throw SceneError(fmt::format("data URI '{}' is not base64 of a known media type", printable(uri.substr(0, 40))),
                       where, "use data:application/octet-stream;base64, image/png or image/jpeg");
    }
    const std::optional<std::size_t> bytes = base64DecodedSize(data->base64);
    if (!bytes) throw SceneError("the base64 of the data URI is malformed", where, kExportAgain);
    return *bytes;
  }

  std::vector<unsigned char>& readExternal(const std::string& uri, const std::string& where) {
    if (folder_.path.empty()) {
      throw SceneError(fmt::format("the file refers to '{}' but is read from memory", printable(uri)), where,
                       "embed buffers and images");
    }
    const std::optional<std::filesystem::path> file = resolveUri(folder_, percentDecode(uri));
    if (!file || (folder_.outside == OutsideFiles::refused && leadsOutside(folder_.path, *file))) {
      throw SceneError(fmt::format("the URI '{}' leaves the folder of the file", printable(uri)), where,
                       "put the file beside the glTF and name it by a relative path, or trust the scene and use "
                       "--allow-outside-files");
    }
    std::error_code error;
    if (!std::filesystem::is_regular_file(*file, error)) {
      throw SceneError(fmt::format("the file '{}' is missing", printable(uri)), where, "put it beside the glTF");
    }
    return resources_.emplace_back(readWholeFile(*file, where));
  }

  std::size_t binaryChunkBytes_;
  const AssetFolder& folder_;
  const GltfSource& source_;
  GltfResources resources_;
};

}  // namespace

GltfResources readResources(const Json& document, std::size_t binaryChunkBytes, const AssetFolder& folder,
                            const GltfSource& source) {
  Reader reader(binaryChunkBytes, folder, source);
  if (document.contains("buffers")) {
    const Json& buffers = document["buffers"];
    for (std::size_t i = 0; i < buffers.size(); ++i) reader.readBuffer(buffers[i], i);
  }
  if (document.contains("images")) {
    const Json& images = document["images"];
    for (std::size_t i = 0; i < images.size(); ++i) reader.readImage(images[i], i);
  }
  return reader.take();
}

std::vector<unsigned char> readWholeFile(const std::filesystem::path& file, const std::string& where) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream ? static_cast<std::streamoff>(stream.tellg()) : -1;
  if (size < 0) throw SceneError("the file cannot be read", where, "check its permissions");
  std::vector<unsigned char> bytes(static_cast<std::size_t>(size));
  stream.seekg(0);
  if (size > 0 && !stream.read(reinterpret_cast<char*>(bytes.data()), size)) {
    throw SceneError("the file cannot be read to its end", where, "check the disk and copy the file again");
  }
  return bytes;
}

}  // namespace importon
