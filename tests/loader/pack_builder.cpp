#include "loader/pack_builder.h"

#include <draco/compression/encode.h>
#include <meshoptimizer.h>

#include "loader/image_builder.h"

namespace importon::test {
namespace {

template <typename T>
void addAttribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, draco::DataType dataType,
                  const std::vector<T>& values) {
  if (values.empty()) return;
  draco::GeometryAttribute attribute;
  attribute.Init(type, nullptr, static_cast<std::int8_t>(T::length()), dataType, false, sizeof(T), 0);
  const int index = mesh.AddAttribute(attribute, true, static_cast<std::uint32_t>(values.size()));
  for (std::uint32_t i = 0; i < values.size(); ++i) {
    mesh.attribute(index)->SetAttributeValue(draco::AttributeValueIndex(i), &values[i]);
  }
}

int addBareAccessor(GltfBuilder& builder, std::size_t count, int componentType, const std::string& type) {
  return builder.add("accessors", {{"componentType", componentType}, {"count", count}, {"type", type}});
}

}  // namespace

Bytes encodeDraco(const PlainMesh& plain, DracoMethod method) {
  draco::Mesh mesh;
  mesh.set_num_points(static_cast<std::uint32_t>(plain.positions.size()));
  mesh.SetNumFaces(plain.indices.size() / 3);
  for (std::uint32_t f = 0; f < mesh.num_faces(); ++f) {
    draco::Mesh::Face face;
    for (std::uint32_t c = 0; c < 3; ++c) face[c] = draco::PointIndex(plain.indices[3 * f + c]);
    mesh.SetFace(draco::FaceIndex(f), face);
  }
  addAttribute(mesh, draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, plain.positions);
  addAttribute(mesh, draco::GeometryAttribute::TEX_COORD, draco::DT_FLOAT32, plain.uvs);
  addAttribute(mesh, draco::GeometryAttribute::GENERIC, draco::DT_UINT8, plain.joints);
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method == DracoMethod::sequential ? draco::MESH_SEQUENTIAL_ENCODING
                                                              : draco::MESH_EDGEBREAKER_ENCODING);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeMeshToBuffer(mesh, &buffer).ok()) return {};
  return Bytes(buffer.data(), buffer.data() + buffer.size());
}

Json& addDracoMesh(GltfBuilder& builder, const PlainMesh& mesh, DracoMethod method) {
  const Bytes encoded = encodeDraco(mesh, method);
  const std::size_t count = mesh.positions.size();
  Json primitive = {{"indices", addBareAccessor(builder, mesh.indices.size(), kUnsignedInt, "SCALAR")}};
  Json& extension = primitive["extensions"]["KHR_draco_mesh_compression"];
  extension["bufferView"] = builder.addView(encoded.data(), encoded.size());
  const auto add = [&](const char* name, int id, int componentType, const char* type) {
    primitive["attributes"][name] = addBareAccessor(builder, count, componentType, type);
    extension["attributes"][name] = id;
  };
  add("POSITION", 0, kFloat, "VEC3");
  int id = 1;
  if (!mesh.uvs.empty()) add("TEXCOORD_0", id++, kFloat, "VEC2");
  if (!mesh.joints.empty()) add("JOINTS_0", id++, kUnsignedByte, "VEC4");
  builder.addMesh(primitive);
  return builder.primitive(builder.json["meshes"].size() - 1);
}

int addMeshoptView(GltfBuilder& builder, const void* data, std::size_t count, std::size_t stride,
                   const std::string& mode, const std::string& filter, const std::string& extension) {
  Bytes encoded;
  if (mode == "ATTRIBUTES") {
    encoded.resize(meshopt_encodeVertexBufferBound(count, stride));
    encoded.resize(meshopt_encodeVertexBuffer(encoded.data(), encoded.size(), data, count, stride));
  } else {
    std::vector<unsigned> indices;
    for (std::size_t i = 0; i < count; ++i) {
      std::uint32_t index = 0;
      std::memcpy(&index, static_cast<const unsigned char*>(data) + i * stride, stride);
      indices.push_back(index);
    }
    encoded.resize(mode == "TRIANGLES" ? meshopt_encodeIndexBufferBound(count, 65536)
                                       : meshopt_encodeIndexSequenceBound(count, 65536));
    encoded.resize(mode == "TRIANGLES"
                       ? meshopt_encodeIndexBuffer(encoded.data(), encoded.size(), indices.data(), count)
                       : meshopt_encodeIndexSequence(encoded.data(), encoded.size(), indices.data(), count));
  }
  const Json from = builder.json["bufferViews"][builder.addView(encoded.data(), encoded.size())];
  Json view = {{"buffer", 1}, {"byteOffset", builder.fallbackBytes}, {"byteLength", count * stride}};
  if (mode == "ATTRIBUTES") view["byteStride"] = stride;
  view["extensions"][extension] = {{"buffer", 0},
                                   {"byteOffset", from["byteOffset"]},
                                   {"byteLength", from["byteLength"]},
                                   {"byteStride", stride},
                                   {"count", count},
                                   {"mode", mode},
                                   {"filter", filter}};
  builder.fallbackBytes += (count * stride + 3) / 4 * 4;
  return builder.add("bufferViews", view);
}

GltfBuilder packedFile() {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const std::vector<glm::vec3> positions = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  const std::vector<glm::vec2> uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  const std::vector<std::uint32_t> indices = {0, 1, 2, 2, 1, 3};
  for (const DracoMethod method : {DracoMethod::sequential, DracoMethod::edgebreaker}) {
    addDracoMesh(builder, {.positions = positions, .uvs = uvs, .indices = indices}, method)["material"] = 0;
  }
  const auto accessor = [&](int view, std::size_t count, int componentType, const char* type) {
    return builder.add("accessors",
                       {{"bufferView", view}, {"count", count}, {"componentType", componentType}, {"type", type}});
  };
  std::vector<glm::i8vec4> normals(4);
  const std::vector<float> directions = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
  meshopt_encodeFilterOct(normals.data(), 4, 4, 8, directions.data());
  const int position = addMeshoptView(builder, positions.data(), 4, 12);
  const int normal = addMeshoptView(builder, normals.data(), 4, 4, "ATTRIBUTES", "OCTAHEDRAL");
  const int index = addMeshoptView(builder, indices.data(), 6, 4, "TRIANGLES");
  const int normalAccessor = accessor(normal, 4, kByte, "VEC3");
  builder.json["accessors"][normalAccessor]["normalized"] = true;
  builder.addMesh({{"attributes", {{"POSITION", accessor(position, 4, kFloat, "VEC3")}, {"NORMAL", normalAccessor}}},
                   {"indices", accessor(index, 6, kUnsignedInt, "SCALAR")},
                   {"material", 0}});
  Json& material = builder.json["materials"][0];
  const auto texture = [&](const Bytes& image) { return Json{{"index", builder.addTexture(image)}}; };
  material["emissiveTexture"] = texture(makeWebp(4, 4, Bytes(64, 100)));
  material["normalTexture"] = texture(makePng({.width = 2, .bitDepth = 16, .colorType = 2}, Bytes(12, 100)));
  material["pbrMetallicRoughness"]["baseColorTexture"] = texture(makeAvif(8, {200, 100, 50, 255}));
  material["pbrMetallicRoughness"]["metallicRoughnessTexture"] =
      texture(makeJpeg(8, 8, Bytes(192, 100), JpegKind::progressive));
  return builder;
}

}  // namespace importon::test
