/// Small glTF files in memory. Tests change `json` as they like before they load.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace importon::test {

using Json = nlohmann::json;
using Bytes = std::vector<unsigned char>;

// componentType of glTF
inline constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125,
                     kFloat = 5126;

[[nodiscard]] std::string base64(std::span<const unsigned char> bytes);
[[nodiscard]] std::span<const std::byte> asBytes(const Bytes& bytes);
[[nodiscard]] Bytes toBytes(const std::string& text);
/// A .glb of these chunks; empty `binary`: no BIN chunk.
[[nodiscard]] Bytes makeGlb(const std::string& jsonText, const Bytes& binary);

/// Holds one buffer. Indices that its functions return are those of glTF.
class GltfBuilder {
 public:
  /// An empty file with one scene without nodes.
  GltfBuilder();
  /// One single-sided triangle (0,0,0) (1,0,0) (0,1,0) of emission (1, 2, 3): the least that loads.
  static GltfBuilder emissiveTriangle();

  /// A buffer view of these bytes, aligned to 4.
  int addView(const void* data, std::size_t bytes);
  /// An accessor of plain values: T is a scalar or a glm vector.
  template <typename T>
  int addAccessor(const std::vector<T>& values, int componentType, const std::string& type) {
    const int view = addView(values.data(), values.size() * sizeof(T));
    return add("accessors",
               {{"bufferView", view}, {"componentType", componentType}, {"count", values.size()}, {"type", type}});
  }
  int addPositions(const std::vector<glm::vec3>& positions) { return addAccessor(positions, kFloat, "VEC3"); }
  int addIndices(const std::vector<std::uint16_t>& indices) { return addAccessor(indices, kUnsignedShort, "SCALAR"); }
  /// An element of a top-level array.
  int add(const std::string& array, const Json& element);
  /// A node that the scene lists.
  int addRoot(const Json& node);
  /// A root with a mesh of one primitive.
  int addMesh(const Json& primitive);
  /// An image in a buffer view and a texture of it.
  int addTexture(const Bytes& encodedImage, const Json& sampler = {});

  [[nodiscard]] Json& primitive(std::size_t mesh = 0) { return json["meshes"][mesh]["primitives"][0]; }
  /// Adds the buffer unless `json` has buffers of its own.
  [[nodiscard]] Bytes glb() const;
  /// As .gltf with the buffer as a data URI.
  [[nodiscard]] Bytes gltf() const;

  Json json;
  Bytes binary;
  std::size_t fallbackBytes = 0;  // of a second buffer that only stands in for compressed views; 0: none
};

}  // namespace importon::test
