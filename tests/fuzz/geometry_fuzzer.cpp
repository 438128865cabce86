/// Feeds random bytes to the decoders of Draco and meshopt data: whatever comes, they end with geometry or a
/// SceneError. For libFuzzer; scripts/fuzz runs it. The first three bytes say what the others are taken for: 0 Draco,
/// then the count of points and of triangles; 1 and more a mode and filter of meshopt, then count and stride.
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/error.h"
#include "scene/container/meshopt_decode.h"
#include "scene/meshes/draco_mesh.h"

namespace {

using nlohmann::json;

/// A document whose only primitive has the stream, POSITION 0 and TEXCOORD_0 1.
importon::GltfDocument dracoDocument(std::span<const std::uint8_t> stream, std::size_t points, std::size_t triangles,
                                     importon::Log& log) {
  const importon::GltfSource source("fuzz");
  const importon::Faults faults(source, log, importon::Strictness::forgiving);
  importon::GltfDocument document{source, {}, faults, {}, {}};
  document.json["bufferViews"] = {{{"buffer", 0}, {"byteLength", stream.size()}}};
  document.json["buffers"] = {{{"byteLength", stream.size()}}};
  document.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", 0}, {"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}};
  tinygltf::Model& model = document.model;
  model.buffers.emplace_back().data.assign(stream.begin(), stream.end());
  model.bufferViews.emplace_back().buffer = 0;
  model.bufferViews[0].byteLength = stream.size();
  tinygltf::Primitive& primitive = model.meshes.emplace_back().primitives.emplace_back();
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes = {{"POSITION", 0}, {"TEXCOORD_0", 1}};
  primitive.indices = 2;
  const auto add = [&](int type, int componentType, std::size_t count) {
    tinygltf::Accessor& accessor = model.accessors.emplace_back();
    accessor.type = type;
    accessor.componentType = componentType;
    accessor.count = count;
  };
  add(TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT, points);
  add(TINYGLTF_TYPE_VEC2, TINYGLTF_COMPONENT_TYPE_FLOAT, points);
  add(TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, 3 * triangles);
  return document;
}

json meshoptExtensionOf(std::size_t kind, std::size_t count, std::size_t stride) {
  constexpr std::array kModes = {"ATTRIBUTES", "TRIANGLES", "INDICES"};
  constexpr std::array kFilters = {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"};
  return {{"mode", kModes[kind % 3]}, {"filter", kFilters[kind / 3 % 4]}, {"count", count}, {"byteStride", stride}};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 4) return 0;
  const std::span stream(data + 3, size - 3);
  importon::Log log(importon::Log::Verbosity::quiet);
  try {
    if (data[0] == 0) {
      importon::GltfDocument document = dracoDocument(stream, data[1], data[2], log);
      importon::decodeDracoMeshes(document, log);
    } else {
      (void)importon::decodeMeshopt(meshoptExtensionOf(data[0] - 1u, data[1], data[2]), stream, "fuzz");
    }
  } catch (const importon::SceneError&) {
  }
  return 0;
}
