#include "scene/container/gltf_view.h"

#include <fmt/format.h>

#include "base/error.h"
#include "scene/container/gltf_advice.h"
#include "scene/container/gltf_json.h"
#include "scene/container/meshopt_decode.h"

namespace importon {
namespace {

using ByteSpan = std::span<const unsigned char>;

/// Throws what is known of a buffer without bytes.
ByteSpan bufferBytes(const GltfDocument& document, std::size_t buffer) {
  if (buffer < document.absences.size() && document.absences[buffer]) throw *document.absences[buffer];
  return document.model.buffers[buffer].data;
}

/// What a view decodes to, kept by the document.
ByteSpan decodedView(const GltfDocument& document, std::size_t index, const nlohmann::json& extension,
                     const std::string& where) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 32;
  const auto known = document.decodedViews.find(index);
  if (known != document.decodedViews.end()) return known->second;
  const ByteSpan buffer = bufferBytes(document, extension["buffer"].get<std::size_t>());
  const auto offset = static_cast<std::size_t>(numberOr(extension, "byteOffset", 0));
  const auto length = extension["byteLength"].get<std::size_t>();
  if (offset > buffer.size() || length > buffer.size() - offset) {
    throw SceneError(
        fmt::format("bytes {} to {} lie outside the buffer of {} bytes", offset, offset + length, buffer.size()), where,
        kExportAgain);
  }
  std::vector<unsigned char> bytes = decodeMeshopt(extension, buffer.subspan(offset, length), where);
  std::size_t total = bytes.size();
  for (const auto& [view, decoded] : document.decodedViews) total += decoded.size();
  if (total > kMostBytes) {
    throw SceneError(fmt::format("the compressed views hold more than {} bytes in all", kMostBytes), where,
                     "reduce the scene");
  }
  return document.decodedViews.emplace(index, std::move(bytes)).first->second;
}

}  // namespace

ByteSpan viewBytes(const GltfDocument& document, std::size_t index) {
  const tinygltf::BufferView& view = document.model.bufferViews[index];
  const nlohmann::json& json = element(member(document.json, "bufferViews"), index);  // null: of addView
  const auto bufferIndex = static_cast<std::size_t>(view.buffer);
  const ByteSpan buffer = document.model.buffers[bufferIndex].data;
  const std::string where = fmt::format("/bufferViews/{}", index);
  const nlohmann::json& extension = meshoptExtension(json);
  const bool isStandIn = isMeshoptFallback(element(member(document.json, "buffers"), bufferIndex));
  if (extension.is_object() && (!isStandIn || buffer.empty())) {
    const ByteSpan bytes = decodedView(document, index, extension, document.source.at(where + "/extensions"));
    if (view.byteLength <= bytes.size()) return bytes.first(view.byteLength);
    throw SceneError(fmt::format("byteLength is {} but {} bytes are decoded", view.byteLength, bytes.size()),
                     document.source.at(where), kExportAgain);
  }
  if (bufferBytes(document, bufferIndex).empty()) {
    throw SceneError("the buffer has no data, it only stands in for compressed views",
                     document.source.at(where + "/buffer"), kExportAgain);
  }
  return buffer.subspan(view.byteOffset, view.byteLength);
}

int addView(GltfDocument& document, std::vector<unsigned char> bytes) {
  tinygltf::Model& model = document.model;
  tinygltf::BufferView& view = model.bufferViews.emplace_back();
  view.buffer = static_cast<int>(model.buffers.size());
  view.byteLength = bytes.size();
  model.buffers.emplace_back().data = std::move(bytes);
  return static_cast<int>(model.bufferViews.size()) - 1;
}

}  // namespace importon
