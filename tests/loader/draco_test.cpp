/// KHR_draco_mesh_compression, of streams that libdraco itself encodes.
#include <gtest/gtest.h>

#include <algorithm>

#include "loader/load.h"
#include "loader/pack_builder.h"

namespace importon::test {
namespace {

/// Two triangles with a seam in no attribute.
PlainMesh square() {
  return {.positions = {{0, 0, 1}, {2, 0, 1}, {0, 3, 1}, {2, 3, 1}},
          .uvs = {{0, 0}, {0.5f, 0}, {0, 0.25f}, {0.5f, 0.25f}},
          .indices = {0, 1, 2, 2, 1, 3}};
}

GltfBuilder fileOf(const PlainMesh& mesh, DracoMethod method) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  addDracoMesh(builder, mesh, method);
  builder.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return builder;
}

/// The corners of all triangles above z = 0, each triangle from its least corner on.
std::vector<std::array<glm::vec3, 3>> trianglesAbove(const Scene& scene) {
  const auto less = [](const glm::vec3& a, const glm::vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  std::vector<std::array<glm::vec3, 3>> triangles;
  for (const Triangle& t : scene.triangles) {
    std::array<glm::vec3, 3> corners;
    const uint vertices[] = {t.v0, t.v1, t.v2};
    for (std::size_t c = 0; c < 3; ++c)
      corners[c] = glm::vec3(glm::dvec3(scene.positions[vertices[c]]) + scene.worldFromRender);
    if (corners[0].z < 0.5f) continue;
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end(), less), corners.end());
    triangles.push_back(corners);
  }
  std::sort(triangles.begin(), triangles.end(), [&](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), less);
  });
  return triangles;
}

TEST(Draco, TrianglesAreThoseThatWereEncoded) {
  GltfBuilder plain = GltfBuilder::emissiveTriangle();
  const PlainMesh mesh = square();
  plain.addMesh({{"attributes", {{"POSITION", plain.addPositions(mesh.positions)}}},
                 {"indices", plain.addAccessor(mesh.indices, kUnsignedInt, "SCALAR")}});
  for (const DracoMethod method : {DracoMethod::sequential, DracoMethod::edgebreaker}) {
    const Scene scene = load(fileOf(mesh, method));
    EXPECT_EQ(trianglesAbove(scene), trianglesAbove(load(plain)));
    EXPECT_EQ(scene.vertices.size(), 7u);
  }
}

TEST(Draco, AttributesAreFoundByTheirIds) {
  PlainMesh mesh = square();
  mesh.joints = {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}};
  const GltfBuilder builder = fileOf(mesh, DracoMethod::edgebreaker);
  const Scene scene = load(builder);
  int found = 0;
  for (std::size_t i = 0; i < scene.vertices.size(); ++i) {
    const glm::vec3 position = glm::vec3(glm::dvec3(scene.positions[i]) + scene.worldFromRender);
    if (position.z < 0.5f) continue;
    EXPECT_EQ(scene.vertices[i].uv0, glm::vec2(position.x / 4, position.y / 12));
    ++found;
  }
  EXPECT_EQ(found, 4);
}

TEST(Draco, MorphTargetsAreNotCompressed) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  Json& primitive = addDracoMesh(builder, square(), DracoMethod::sequential);
  primitive["targets"] = {{{"POSITION", builder.addPositions(std::vector<glm::vec3>(4, {0, 0, 2}))}}};
  builder.json["meshes"][1]["weights"] = {0.5};
  for (const auto& corners : trianglesAbove(load(builder))) EXPECT_EQ(corners[0].z, 2.0f);
}

TEST(Draco, WhatDoesNotFitItsAccessorIsRefused) {
  const auto errorWith = [](const std::function<void(GltfBuilder&, Json & primitive)>& change) {
    GltfBuilder builder = GltfBuilder::emissiveTriangle();
    addDracoMesh(builder, square(), DracoMethod::sequential);
    change(builder, builder.primitive(1));
    return errorOf(builder);
  };
  const auto accessorOf = [](GltfBuilder& builder, const char* name) -> Json& {
    return builder.json["accessors"][builder.primitive(1)["attributes"][name].get<int>()];
  };
  const std::string where = "(test.glb#/meshes/1/primitives/0/extensions/KHR_draco_mesh_compression)";
  const std::string count = errorWith([&](GltfBuilder& b, Json&) { accessorOf(b, "TEXCOORD_0")["count"] = 5; });
  EXPECT_NE(count.find("TEXCOORD_0 has 5 elements of 2 numbers but 4 of 2 are decoded " + where), std::string::npos)
      << count;
  const std::string type = errorWith([&](GltfBuilder& b, Json&) { accessorOf(b, "TEXCOORD_0")["type"] = "VEC3"; });
  EXPECT_NE(type.find("4 elements of 3 numbers but 4 of 2"), std::string::npos) << type;
  const std::string id = errorWith([](GltfBuilder&, Json& primitive) {
    primitive["extensions"]["KHR_draco_mesh_compression"]["attributes"]["TEXCOORD_0"] = 9;
  });
  EXPECT_NE(id.find("TEXCOORD_0 is not among the Draco attributes"), std::string::npos) << id;
  const std::string indices = errorWith(
      [](GltfBuilder& b, Json& primitive) { b.json["accessors"][primitive["indices"].get<int>()]["count"] = 9; });
  EXPECT_NE(indices.find("9 indices but 6 are decoded"), std::string::npos) << indices;
  const std::string component =
      errorWith([&](GltfBuilder& b, Json&) { accessorOf(b, "POSITION")["componentType"] = 5127; });
  EXPECT_NE(component.find("does not fit the component type 5127"), std::string::npos) << component;
}

TEST(Draco, NormalisedWhereTheAccessorSaysSo) {
  PlainMesh mesh = square();
  mesh.joints = {{0, 51, 102, 255}, {0, 51, 102, 255}, {0, 51, 102, 255}, {0, 51, 102, 255}};
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  Json& primitive = addDracoMesh(builder, mesh, DracoMethod::sequential);
  Json& extension = primitive["extensions"]["KHR_draco_mesh_compression"]["attributes"];
  primitive["attributes"]["COLOR_0"] = primitive["attributes"]["JOINTS_0"];
  extension["COLOR_0"] = extension["JOINTS_0"];
  primitive["attributes"].erase("JOINTS_0");
  extension.erase("JOINTS_0");
  builder.json["accessors"][primitive["attributes"]["COLOR_0"].get<int>()]["normalized"] = true;
  Log log(Log::Verbosity::quiet);
  const Scene scene = load(builder.glb(), log);
  EXPECT_EQ(glm::unpackHalf2x16(scene.vertices[4].colorBA),
            glm::vec2(glm::unpackHalf2x16(glm::packHalf2x16({0.4f, 1}))));
}

TEST(Draco, TheUncompressedMeshStandsInForDamagedData) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const PlainMesh mesh = square();
  Json& primitive = addDracoMesh(builder, mesh, DracoMethod::edgebreaker);
  const std::size_t view = primitive["extensions"]["KHR_draco_mesh_compression"]["bufferView"].get<std::size_t>();
  builder.binary[builder.json["bufferViews"][view]["byteOffset"].get<std::size_t>()] ^= 1;
  EXPECT_NE(errorOf(builder).find("no header of a mesh"), std::string::npos);
  primitive["attributes"] = {{"POSITION", builder.addPositions(mesh.positions)}};
  builder.primitive(1)["indices"] = builder.addAccessor(mesh.indices, kUnsignedInt, "SCALAR");
  Log log(Log::Verbosity::quiet);
  EXPECT_EQ(load(builder.glb(), log).triangles.size(), 3u);
  ASSERT_EQ(log.warnings().size(), 1u);
  EXPECT_NE(log.warnings()[0].message.find("the uncompressed mesh beside it is shown"), std::string::npos);
}

TEST(Draco, AStreamThatIsCutOffIsRefused) {
  const GltfBuilder whole = fileOf(square(), DracoMethod::sequential);
  const std::size_t view = 1;
  const std::size_t length = whole.json["bufferViews"][view]["byteLength"].get<std::size_t>();
  for (std::size_t cut = 1; cut < length; ++cut) {
    GltfBuilder builder = whole;
    builder.json["bufferViews"][view]["byteLength"] = cut;
    EXPECT_NE(errorOf(builder), "") << cut;
  }
}

}  // namespace
}  // namespace importon::test
