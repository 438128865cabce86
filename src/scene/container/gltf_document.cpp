#include "scene/container/gltf_document.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "scene/container/gltf_advice.h"
#include "scene/container/gltf_choices.h"
#include "scene/container/gltf_container.h"
#include "scene/container/gltf_extensions.h"
#include "scene/container/gltf_json.h"
#include "scene/container/gltf_resources.h"
#include "scene/container/gltf_schema.h"
#include "scene/container/lenient_json.h"
#include "scene/materials/specular_glossiness.h"
#include "scene/materials/webgl_technique.h"

namespace importon {
namespace {

/// Other versions have another structure: this comes before all else, which is left to checkSchema.
void checkVersion(nlohmann::json& document, const GltfSource& source, const Faults& faults) {
  for (const char* pointer : {"/asset/version", "/asset/minVersion"}) {
    const nlohmann::json::json_pointer place(pointer);
    if (!document.contains(place)) continue;
    if (document[place].is_number() && document[place] < 2) document[place] = document[place].dump();
    if (!document[place].is_string()) continue;
    auto& version = document[place].get_ref<std::string&>();
    if (version == "2") {
      faults.forgive("version without a minor", pointer, "the version is '2'", "it is taken for 2.0");
      version = "2.0";
    }
    const bool isReadable =
        std::string_view(pointer).ends_with("/version") ? version.starts_with("2.") : version == "2.0";
    if (isReadable) continue;
    throw SceneError(fmt::format("the file needs glTF version {}", printable(version)), source.at(pointer),
                     "convert it to glTF 2.0");
  }
  const nlohmann::json& meshes = member(document, "meshes");
  if (!member(document, "asset", "version").is_null() || !meshes.is_object()) return;
  throw SceneError("the file needs glTF version 1.0", source.at("/meshes"), "convert it to glTF 2.0");
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

/// What tinygltf reads: all but the bytes, which it would decode its own way, animations, which
/// poseDocument reads, and what it refuses: indices of primitives without a buffer view, as compressed ones, and
/// strides that are no multiple of 4 or above 252; lights of a kind that is not known.
nlohmann::json structureOf(const nlohmann::json& document) {
  nlohmann::json structure = nlohmann::json::object();
  for (const auto& [key, value] : document.items()) {
    if (key != "buffers" && key != "images" && key != "animations") structure[key] = value;
  }
  if (structure.contains("bufferViews")) {
    for (nlohmann::json& view : structure["bufferViews"]) view.erase("byteStride");
  }
  const nlohmann::json::json_pointer lights("/extensions/KHR_lights_punctual/lights");
  if (structure.contains(lights)) {
    for (nlohmann::json& light : structure[lights])
      if (!light.contains("type")) light["type"] = "";  // of a kind that is not known
  }
  if (!structure.contains("meshes")) return structure;
  for (nlohmann::json& mesh : structure["meshes"]) {
    for (nlohmann::json& primitive : mesh["primitives"]) primitive.erase("indices");
  }
  return structure;
}

/// Gives the model what structureOf left out.
void complete(const nlohmann::json& document, tinygltf::Model& model) {
  const nlohmann::json& views = member(document, "bufferViews");
  for (std::size_t v = 0; v < model.bufferViews.size(); ++v) {
    model.bufferViews[v].byteStride = static_cast<std::size_t>(integerOr(views[v], "byteStride", 0));
  }
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
  complete(document, model);
  return model;
}

}  // namespace

void rereadModel(GltfDocument& document) {
  std::vector<tinygltf::Buffer> buffers = std::move(document.model.buffers);
  document.model = parseModel(document.json, document.source);
  document.model.buffers = std::move(buffers);
}

GltfDocument readDocument(std::span<const std::byte> bytes, const std::filesystem::path& name,
                          const AssetFolder& folder, Log& log, const FileChoices& choices) {
  const GltfSource source(printable(name.string(), 4096));
  GltfDocument document{source, folder, Faults(source, log, choices.strictness), {}, {}};
  const Faults& faults = document.faults;
  const GltfContainer container = readContainer(bytes, source, faults, log);
  nlohmann::json& json = document.json = parseLenient(container.json, source, faults);
  checkVersion(json, source, faults);
  checkSchema(json, source, faults);
  checkExtensions(json, source, faults, log);
  applyChoices(json, choices);
  convertSpecularGlossiness(json);
  convertTechniques(json, faults);
  checkBufferViews(json, source);
  document.model = parseModel(json, source);
  for (BufferData& buffer : readBuffers(json, container.binaryChunk, folder, source, log)) {
    document.model.buffers.emplace_back().data = std::move(buffer.bytes);
    document.absences.push_back(std::move(buffer.absence));
  }
  return document;
}

}  // namespace importon
