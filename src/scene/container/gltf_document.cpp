#include "scene/container/gltf_document.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "scene/container/gltf_advice.h"
#include "scene/container/gltf_container.h"
#include "scene/container/gltf_extensions.h"
#include "scene/container/gltf_resources.h"
#include "scene/container/gltf_schema.h"

namespace importon {
namespace {

nlohmann::json parseJson(std::string_view text, const GltfSource& source) {
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    throw SceneError(fmt::format("the JSON is malformed: {}", printable(error.what())), source.name(), kExportAgain);
  }
}

/// Other versions have another structure: this comes before all else, which is left to checkSchema.
void checkVersion(const nlohmann::json& document, const GltfSource& source) {
  for (const char* pointer : {"/asset/version", "/asset/minVersion"}) {
    const nlohmann::json::json_pointer place(pointer);
    if (!document.contains(place) || !document[place].is_string()) continue;
    const auto& version = document[place].get_ref<const std::string&>();
    const bool isReadable =
        std::string_view(pointer).ends_with("/version") ? version.starts_with("2.") : version == "2.0";
    if (isReadable) continue;
    throw SceneError(fmt::format("the file needs glTF version {}", printable(version)), source.at(pointer),
                     "convert it to glTF 2.0");
  }
}

/// Buffer views must lie in their buffers: tinygltf 2.7 hands images out of them without looking.
void checkBufferViews(const nlohmann::json& document, const GltfSource& source) {
  if (!document.contains("bufferViews")) return;
  const nlohmann::json& views = document["bufferViews"];
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto offset = views[i].value("byteOffset", std::size_t{0});
    const auto length = views[i]["byteLength"].get<std::size_t>();
    const auto& buffer = document["buffers"][views[i]["buffer"].get<std::size_t>()];
    const auto available = buffer["byteLength"].get<std::size_t>();
    if (offset <= available && length <= available - offset) continue;
    throw SceneError(
        fmt::format("bytes {} to {} lie outside the buffer of {} bytes", offset, offset + length, available),
        source.at(fmt::format("/bufferViews/{}", i)), kExportAgain);
  }
}

/// Hands over the next resource, whatever the name.
bool takeResource(std::vector<unsigned char>* bytes, std::string*, const std::string&, void* userData) {
  auto& resources = *static_cast<GltfResources*>(userData);
  if (resources.empty()) return false;
  *bytes = std::move(resources.front());
  resources.pop_front();
  return true;
}

/// Keeps the bytes of an image with a URI as they are; those in a buffer view stay there.
bool keepImageBytes(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes,
                    int size, void*) {
  if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
  return true;
}

/// tinygltf sees no file system: what it may read lies in `resources`.
tinygltf::Model parseModel(std::span<const std::byte> bytes, const GltfContainer& container, GltfResources& resources,
                           const GltfSource& source) {
  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(keepImageBytes, nullptr);
  parser.SetFsCallbacks({[](const std::string&, void*) { return true; },
                         [](const std::string& name, void*) { return name; }, takeResource, nullptr, &resources});
  tinygltf::Model model;
  std::string error;
  std::string warning;
  bool isLoaded = false;
  try {
    isLoaded = container.isBinary ? parser.LoadBinaryFromMemory(&model, &error, &warning,
                                                                reinterpret_cast<const unsigned char*>(bytes.data()),
                                                                static_cast<unsigned>(bytes.size()))
                                  : parser.LoadASCIIFromString(&model, &error, &warning, container.json.data(),
                                                               static_cast<unsigned>(container.json.size()), "");
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  if (!isLoaded) {
    throw SceneError(fmt::format("malformed glTF: {}", printable(error.substr(0, error.find('\n')))), source.name(),
                     kExportAgain);
  }
  return model;
}

}  // namespace

GltfDocument readDocument(std::span<const std::byte> bytes, const std::filesystem::path& name,
                          const AssetFolder& folder, Log& log) {
  GltfDocument document{GltfSource(printable(name.string(), 4096)), {}, {}};
  const GltfSource& source = document.source;
  const GltfContainer container = readContainer(bytes, source);
  document.json = parseJson(container.json, source);
  const nlohmann::json& json = document.json;
  checkVersion(json, source);
  checkSchema(json, source);
  checkExtensions(json, source, log);
  checkBufferViews(json, source);
  const std::size_t chunkBytes = container.binaryChunk ? container.binaryChunk->size() : 0;
  GltfResources resources = readResources(json, chunkBytes, folder, source);
  document.model = parseModel(bytes, container, resources, source);
  return document;
}

}  // namespace importon
