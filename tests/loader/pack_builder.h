/// Compressed geometry for tests, by the libraries' own encoders.
#pragma once
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "loader/gltf_builder.h"

namespace importon::test {

/// A mesh of a few attributes; all as long as `positions` or empty.
struct PlainMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec2> uvs{};
  std::vector<glm::u8vec4> joints{};
  std::vector<std::uint32_t> indices;
};

enum class DracoMethod { sequential, edgebreaker };

/// POSITION 0, TEXCOORD_0 1, JOINTS_0 2, as far as `mesh` has them. Not quantised.
[[nodiscard]] Bytes encodeDraco(const PlainMesh& mesh, DracoMethod method);

/// A root that shows the mesh compressed; its accessors have no views. Returns the primitive.
Json& addDracoMesh(GltfBuilder& builder, const PlainMesh& mesh, DracoMethod method);

/// A buffer view of `count` elements of `stride` bytes, compressed; `mode` and `filter` as in EXT_meshopt_compression.
/// Data of a filter are as its encoder made them.
int addMeshoptView(GltfBuilder& builder, const void* data, std::size_t count, std::size_t stride,
                   const std::string& mode = "ATTRIBUTES", const std::string& filter = "NONE",
                   const std::string& extension = "EXT_meshopt_compression");

/// A file that packs all it can: Draco, meshopt and images of all kinds.
[[nodiscard]] GltfBuilder packedFile();

}  // namespace importon::test
