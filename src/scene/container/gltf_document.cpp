#include "scene/container/gltf_document.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "scene/container/gltf_advice.h"
#include "scene/container/gltf_container.h"
#include "scene/container/gltf_extensions.h"
#include "scene/container/gltf_json.h"
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

/// Buffer views must lie in their buffers.
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

/// What tinygltf reads: all but the bytes, which it would decode its own way, and the indices of primitives, which it
/// refuses where they have no buffer view, as compressed ones.
nlohmann::json structureOf(const nlohmann::json& document) {
  nlohmann::json structure = nlohmann::json::object();
  for (const auto& [key, value] : document.items()) {
    if (key != "buffers" && key != "images") structure[key] = value;
  }
  if (!structure.contains("meshes")) return structure;
  for (nlohmann::json& mesh : structure["meshes"]) {
    for (nlohmann::json& primitive : mesh["primitives"]) primitive.erase("indices");
  }
  return structure;
}

void addIndices(const nlohmann::json& document, tinygltf::Model& model) {
  for (std::size_t m = 0; m < model.meshes.size(); ++m) {
    const nlohmann::json& primitives = document["meshes"][m]["primitives"];
    for (std::size_t p = 0; p < model.meshes[m].primitives.size(); ++p) {
      model.meshes[m].primitives[p].indices = integerOr(primitives[p], "indices", -1);
    }
  }
}

/// tinygltf sees no file system.
tinygltf::Model parseModel(const nlohmann::json& document, const GltfSource& source) {
  tinygltf::TinyGLTF parser;
  tinygltf::Model model;
  std::string error;
  std::string warning;
  bool isLoaded = false;
  try {
    const std::string text = structureOf(document).dump();
    isLoaded =
        parser.LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned>(text.size()), "");
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  if (!isLoaded) {
    throw SceneError(fmt::format("malformed glTF: {}", printable(error.substr(0, error.find('\n')))), source.name(),
                     kExportAgain);
  }
  addIndices(document, model);
  return model;
}

}  // namespace

GltfDocument readDocument(std::span<const std::byte> bytes, const std::filesystem::path& name,
                          const AssetFolder& folder, Log& log) {
  GltfDocument document{GltfSource(printable(name.string(), 4096)), folder, {}, {}};
  const GltfSource& source = document.source;
  const GltfContainer container = readContainer(bytes, source);
  document.json = parseJson(container.json, source);
  const nlohmann::json& json = document.json;
  checkVersion(json, source);
  checkSchema(json, source);
  checkExtensions(json, source, log);
  checkBufferViews(json, source);
  document.model = parseModel(json, source);
  for (std::vector<unsigned char>& data : readBuffers(json, container.binaryChunk, folder, source, log)) {
    document.model.buffers.emplace_back().data = std::move(data);
  }
  return document;
}

}  // namespace importon
