#include "scene/meshes/draco_mesh.h"

#include <draco/compression/decode.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "base/error.h"
#include "scene/container/gltf_advice.h"
#include "scene/container/gltf_json.h"
#include "scene/container/gltf_view.h"
#include "scene/meshes/draco_header.h"

namespace importon {
namespace {

using Json = nlohmann::json;
using Bytes = std::vector<unsigned char>;

constexpr const char* kExtension = "KHR_draco_mesh_compression";

std::unique_ptr<draco::Mesh> decodeStream(std::span<const unsigned char> stream, const std::string& where) {
  checkDracoHeader(stream, where);
  std::string reason;
  try {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (decoded.ok()) return std::move(decoded).value();
    reason = decoded.status().error_msg_string();
  } catch (const std::exception& exception) {
    reason = exception.what();
  }
  throw SceneError(fmt::format("the Draco data cannot be decoded ({})", printable(reason)), where, kExportAgain);
}

/// The values of all points as components of type T; false if one does not fit.
template <typename T>
bool convertPoints(const draco::PointAttribute& attribute, std::size_t points, Bytes& out) {
  const auto components = static_cast<std::size_t>(attribute.num_components());
  out.resize(points * components * sizeof(T));
  T value[4] = {};
  for (std::size_t i = 0; i < points; ++i) {
    const draco::AttributeValueIndex place = attribute.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(i)));
    if (place.value() >= attribute.size()) return false;
    if (!attribute.ConvertValue<T>(place, static_cast<std::int8_t>(components), value)) return false;
    std::memcpy(out.data() + i * components * sizeof(T), value, components * sizeof(T));
  }
  return true;
}

bool convertPoints(const draco::PointAttribute& attribute, int componentType, std::size_t points, Bytes& out) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return convertPoints<std::int8_t>(attribute, points, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return convertPoints<std::uint8_t>(attribute, points, out);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return convertPoints<std::int16_t>(attribute, points, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return convertPoints<std::uint16_t>(attribute, points, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return convertPoints<std::uint32_t>(attribute, points, out);
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return convertPoints<float>(attribute, points, out);
    default:
      return false;
  }
}

/// Replaces the accessors of one primitive.
class Expansion {
 public:
  Expansion(GltfDocument& document, const draco::Mesh& mesh, std::string where, Log& log)
      : document_(document), mesh_(mesh), where_(std::move(where)), log_(log) {}

  /// The primitive with its new accessors.
  tinygltf::Primitive run(tinygltf::Primitive primitive, const Json& attributes) {
    for (const auto& [name, id] : attributes.items()) {
      const auto entry = primitive.attributes.find(name);
      if (entry != primitive.attributes.end()) entry->second = expand(name, id, accessor(entry->second));
    }
    primitive.indices = expandIndices(primitive.indices);
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    return primitive;
  }

  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw SceneError(what, where_, kExportAgain); }

  const tinygltf::Accessor& accessor(int index) const {
    return document_.model.accessors[static_cast<std::size_t>(index)];
  }

  int expand(const std::string& name, const Json& id, const tinygltf::Accessor& declared) {
    const bool isId = id.is_number_unsigned() && id.get<std::uint64_t>() < (std::uint64_t{1} << 32);
    const draco::PointAttribute* attribute =
        isId ? mesh_.GetAttributeByUniqueId(static_cast<std::uint32_t>(id.get<std::uint64_t>())) : nullptr;
    if (attribute == nullptr) fail(fmt::format("{} is not among the Draco attributes", printable(name)));
    const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(declared.type));
    const bool isVector = components >= 1 && components <= 4 && declared.type != TINYGLTF_TYPE_MAT2;
    if (!isVector || components != attribute->num_components() || declared.count != mesh_.num_points()) {
      fail(fmt::format("{} has {} elements of {} numbers but {} of {} are decoded", printable(name), declared.count,
                       components, mesh_.num_points(), attribute->num_components()));
    }
    if (attribute->normalized() != declared.normalized && draco::IsDataTypeIntegral(attribute->data_type())) {
      log_.detail(fmt::format("{}: {} is {} as its accessor says, though its Draco data say otherwise", where_,
                              printable(name), declared.normalized ? "normalised" : "not normalised"));
    }
    Bytes data;
    if (!convertPoints(*attribute, declared.componentType, mesh_.num_points(), data)) {
      fail(fmt::format("{} does not fit the component type {} of its accessor", printable(name),
                       declared.componentType));
    }
    return addAccessor(std::move(data), declared);
  }

  int expandIndices(int declared) {
    const std::size_t count = std::size_t{3} * mesh_.num_faces();
    if (count == 0) fail("the Draco data hold no triangle");
    if (declared >= 0 && accessor(declared).count != count) {
      fail(fmt::format("there are {} indices but {} are decoded", accessor(declared).count, count));
    }
    Bytes data(count * sizeof(std::uint32_t));
    for (std::uint32_t i = 0; i < mesh_.num_faces(); ++i) {
      const draco::Mesh::Face& face = mesh_.face(draco::FaceIndex(i));
      const std::uint32_t corners[] = {face[0].value(), face[1].value(), face[2].value()};
      std::memcpy(data.data() + i * sizeof corners, corners, sizeof corners);
    }
    tinygltf::Accessor indices;
    indices.type = TINYGLTF_TYPE_SCALAR;
    indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    indices.count = count;
    return addAccessor(std::move(data), indices);
  }

  int addAccessor(Bytes data, tinygltf::Accessor accessor) {
    tinygltf::Model& model = document_.model;
    bytes_ += data.size();
    accessor.bufferView = addView(document_, std::move(data));
    accessor.byteOffset = 0;
    accessor.sparse.isSparse = false;
    model.accessors.push_back(std::move(accessor));
    return static_cast<int>(model.accessors.size()) - 1;
  }

  GltfDocument& document_;
  const draco::Mesh& mesh_;
  std::string where_;
  Log& log_;
  std::size_t bytes_ = 0;
};

/// Whether all that a primitive needs is there uncompressed.
bool hasOwnData(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  const auto hasView = [&](int accessor) {
    return model.accessors[static_cast<std::size_t>(accessor)].bufferView >= 0;
  };
  return (primitive.indices < 0 || hasView(primitive.indices)) &&
         std::all_of(primitive.attributes.begin(), primitive.attributes.end(),
                     [&](const auto& attribute) { return hasView(attribute.second); });
}

class DracoDecoder {
 public:
  DracoDecoder(GltfDocument& document, Log& log) : document_(document), log_(log) {}

  void decode(tinygltf::Primitive& primitive, const Json& extension, const std::string& pointer) {
    const std::string where = document_.source.at(fmt::format("{}/extensions/{}", pointer, kExtension));
    try {
      Expansion expansion(document_, meshOf(extension["bufferView"].get<std::size_t>(), where), where, log_);
      primitive = expansion.run(primitive, extension["attributes"]);
      bytes_ += expansion.bytes();
    } catch (const SceneError& error) {
      if (!hasOwnData(document_.model, primitive)) throw;
      log_.warn("Draco data", fmt::format("{}; the uncompressed mesh beside it is shown", error.what()));
    }
    constexpr std::size_t kMostBytes = std::size_t{1} << 32;
    if (bytes_ <= kMostBytes) return;
    throw SceneError(fmt::format("the Draco meshes hold more than {} bytes in all", kMostBytes), where,
                     "reduce the scene");
  }

 private:
  /// Primitives one after another often share a stream.
  const draco::Mesh& meshOf(std::size_t view, const std::string& where) {
    if (!mesh_ || view != view_) mesh_ = decodeStream(viewBytes(document_, view), where);
    view_ = view;
    return *mesh_;
  }

  GltfDocument& document_;
  Log& log_;
  std::unique_ptr<draco::Mesh> mesh_;
  std::size_t view_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace

void decodeDracoMeshes(GltfDocument& document, Log& log) {
  DracoDecoder decoder(document, log);
  for (std::size_t m = 0; m < document.model.meshes.size(); ++m) {
    std::vector<tinygltf::Primitive>& primitives = document.model.meshes[m].primitives;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const Json& extension = member(document.json["meshes"][m]["primitives"][p], "extensions", kExtension);
      if (!extension.is_object() || primitives[p].mode < TINYGLTF_MODE_TRIANGLES) continue;
      decoder.decode(primitives[p], extension, fmt::format("/meshes/{}/primitives/{}", m, p));
    }
  }
}

}  // namespace importon
