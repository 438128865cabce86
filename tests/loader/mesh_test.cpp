#include <gtest/gtest.h>

#include "loader/load.h"
#include "scene/meshes/triangulate.h"
#include "scene/packing.h"

namespace importon::test {
namespace {

TEST(Triangulate, TrianglesComeThreeByThree) {
  EXPECT_EQ(triangulate(TriangleMode::triangles, 7), (std::vector<uvec3>{{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(triangulate(TriangleMode::triangles, std::vector<uint>{9, 8, 7}), (std::vector<uvec3>{{9, 8, 7}}));
}

TEST(Triangulate, StripsTurnEveryOtherTriangle) {
  EXPECT_EQ(triangulate(TriangleMode::strip, 5), (std::vector<uvec3>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
}

TEST(Triangulate, FansShareTheFirstVertex) {
  EXPECT_EQ(triangulate(TriangleMode::fan, 5), (std::vector<uvec3>{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
}

TEST(Triangulate, StitchesOfStripsAreLeftOut) {
  EXPECT_EQ(triangulate(TriangleMode::strip, std::vector<uint>{0, 1, 2, 2, 3, 3, 4, 5}),
            (std::vector<uvec3>{{0, 1, 2}, {3, 5, 4}}));
}

TEST(Triangulate, FewerThanThreeVerticesGiveNothing) {
  for (const TriangleMode mode : {TriangleMode::triangles, TriangleMode::strip, TriangleMode::fan}) {
    EXPECT_TRUE(triangulate(mode, 2).empty());
    EXPECT_TRUE(triangulate(mode, std::vector<uint>()).empty());
  }
}

/// A unit square of four vertices, counter-clockwise.
GltfBuilder square(int mode) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const bool isStrip = mode == 5;
  builder.primitive()["attributes"]["POSITION"] =
      isStrip ? builder.addPositions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}})
              : builder.addPositions({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  builder.primitive()["mode"] = mode;
  if (mode == 4) builder.primitive()["indices"] = builder.addIndices({0, 1, 2, 0, 2, 3});
  return builder;
}

TEST(Mesh, TrianglesStripsAndFansCoverTheSameSquare) {
  for (const int mode : {4, 5, 6}) {
    const Scene scene = load(square(mode));
    ASSERT_EQ(scene.triangles.size(), 2u) << mode;
    double area = 0;
    for (const Triangle& t : scene.triangles) {
      const vec3 a = scene.positions[t.v0];
      area += 0.5 * glm::cross(scene.positions[t.v1] - a, scene.positions[t.v2] - a).z;
    }
    EXPECT_DOUBLE_EQ(area, 1.0) << mode;
  }
}

TEST(Mesh, IndexedStripsAndFansFollowTheirIndices) {
  GltfBuilder builder = square(5);
  builder.primitive()["indices"] = builder.addIndices({3, 1, 2});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.triangles.size(), 1u);
  EXPECT_EQ(scene.triangles[0].v0, 3u);
}

TEST(Mesh, PointsAndLinesArePassedOverWithOneWarning) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  for (const int mode : {0, 1, 2, 3}) {
    builder.addMesh({{"attributes", {{"POSITION", 0}}}, {"mode", mode}});
  }
  Log log(Log::Verbosity::quiet);
  EXPECT_EQ(load(builder.glb(), log).triangles.size(), 1u);
  ASSERT_EQ(log.warnings().size(), 1u);
  EXPECT_EQ(log.warnings()[0].kind, "points and lines");
  EXPECT_EQ(log.warnings()[0].count, 4u);
}

TEST(Mesh, CornersThatMakeNoTriangleAreReported) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.primitive()["indices"] = builder.addIndices({0, 1, 2, 0});
  Log log(Log::Verbosity::quiet);
  EXPECT_EQ(load(builder.glb(), log).triangles.size(), 1u);
  ASSERT_EQ(log.warnings().size(), 1u);
  EXPECT_EQ(log.warnings()[0].kind, "incomplete triangle");
}

TEST(Mesh, WithoutNormalsShadingIsFlat) {
  const Scene scene = load(GltfBuilder::emissiveTriangle());
  for (const Vertex& vertex : scene.vertices) {
    EXPECT_EQ(vertex.normal, kNone);
    EXPECT_EQ(vertex.tangent, kNone);
  }
}

TEST(Mesh, DegenerateNormalsAndTangentsAreNone) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  builder.primitive()["attributes"]["NORMAL"] = builder.addPositions({{0, 0, 0}, {nan, 0, 1}, {0, 0, 2}});
  builder.primitive()["attributes"]["TANGENT"] =
      builder.addAccessor(std::vector<glm::vec4>{{0, 0, 0, 1}, {nan, 0, 0, 1}, {3, 0, 0, -1}}, kFloat, "VEC4");
  const Scene scene = load(builder);
  EXPECT_EQ(scene.vertices[0].normal, kNone);
  EXPECT_EQ(scene.vertices[1].normal, kNone);
  EXPECT_EQ(unpackNormal(scene.vertices[2].normal), vec3(0, 0, 1));
  EXPECT_EQ(scene.vertices[0].tangent, kNone);
  EXPECT_EQ(scene.vertices[1].tangent, kNone);
  EXPECT_EQ(unpackTangent(scene.vertices[2].tangent), vec4(1, 0, 0, -1));
}

TEST(Mesh, BothUvSetsAndColoursArrive) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  Json& attributes = builder.primitive()["attributes"];
  attributes["TEXCOORD_0"] = builder.addAccessor(std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}, kFloat, "VEC2");
  const int second =
      builder.addAccessor(std::vector<glm::u8vec4>{{0, 255, 0, 0}, {51, 0, 0, 0}, {0, 0, 0, 0}}, kUnsignedByte, "VEC2");
  builder.json["accessors"][second]["normalized"] = true;
  builder.json["bufferViews"][builder.json["accessors"][second]["bufferView"].get<int>()]["byteStride"] = 4;
  builder.primitive()["attributes"]["TEXCOORD_1"] = second;
  builder.primitive()["attributes"]["COLOR_0"] =
      builder.addAccessor(std::vector<glm::vec4>{{0.5f, 0.25f, 0, 1}, {1, 1, 1, 0.5f}, {0, 0, 0, 0}}, kFloat, "VEC4");
  const Scene scene = load(builder);
  EXPECT_EQ(scene.vertices[1].uv0, vec2(1, 0));
  EXPECT_EQ(scene.vertices[0].uv1, vec2(0, 1));
  EXPECT_EQ(scene.vertices[1].uv1, vec2(0.2f, 0));
  EXPECT_EQ(glm::unpackHalf2x16(scene.vertices[0].colorRG), vec2(0.5f, 0.25f));
  EXPECT_EQ(glm::unpackHalf2x16(scene.vertices[1].colorBA), vec2(1, 0.5f));
}

TEST(Mesh, ColoursAreWhiteUnlessGiven) {
  const Vertex vertex = load(GltfBuilder::emissiveTriangle()).vertices[0];
  EXPECT_EQ(glm::unpackHalf2x16(vertex.colorRG), vec2(1));
  EXPECT_EQ(glm::unpackHalf2x16(vertex.colorBA), vec2(1));
}

TEST(Mesh, NonFiniteUvsAndColoursAreReplaced) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  builder.primitive()["attributes"]["TEXCOORD_0"] =
      builder.addAccessor(std::vector<glm::vec2>{{nan, 0}, {1, 0}, {0, 1}}, kFloat, "VEC2");
  builder.primitive()["attributes"]["COLOR_0"] =
      builder.addAccessor(std::vector<glm::vec3>{{nan, 0.5f, -3}, {1, 1, 1}, {1, 1, 1}}, kFloat, "VEC3");
  Log log(Log::Verbosity::quiet);
  const Scene scene = load(builder.glb(), log);
  EXPECT_EQ(scene.vertices[0].uv0, vec2(0));
  EXPECT_EQ(glm::unpackHalf2x16(scene.vertices[0].colorRG), vec2(1, 0.5f));
  EXPECT_EQ(glm::unpackHalf2x16(scene.vertices[0].colorBA), vec2(0, 1));
  ASSERT_EQ(log.warnings().size(), 1u);
  EXPECT_NE(log.warnings()[0].message.find("1 texture coordinates"), std::string::npos);
}

/// A triangle with a morph target that lifts vertex 2 by 4.
GltfBuilder morphing() {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const int change = builder.addPositions({{0, 0, 0}, {0, 0, 0}, {0, 0, 4}});
  builder.primitive()["targets"] = Json::array({{{"POSITION", change}}});
  return builder;
}

TEST(MorphTargets, StandAtTheWeightsOfTheMesh) {
  GltfBuilder builder = morphing();
  EXPECT_EQ(load(builder).positions[2], vec3(0, 1, 0));
  builder.json["meshes"][0]["weights"] = {0.5};
  EXPECT_EQ(load(builder).positions[2], vec3(0, 1, 2));
}

TEST(MorphTargets, TheWeightsOfANodeComeFirst) {
  GltfBuilder builder = morphing();
  builder.json["meshes"][0]["weights"] = {0.5};
  builder.addRoot({{"mesh", 0}, {"weights", {1}}});
  const Scene scene = load(builder);
  EXPECT_EQ(scene.positions[scene.triangles[0].v2], vec3(0, 1, 2));
  EXPECT_EQ(scene.positions[scene.triangles[1].v2], vec3(0, 1, 4));
}

TEST(MorphTargets, NormalsAndTangentsMoveToo) {
  GltfBuilder builder = morphing();
  builder.primitive()["attributes"]["NORMAL"] = builder.addPositions({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
  builder.primitive()["attributes"]["TANGENT"] =
      builder.addAccessor(std::vector<glm::vec4>{{1, 0, 0, -1}, {1, 0, 0, -1}, {1, 0, 0, -1}}, kFloat, "VEC4");
  builder.primitive()["targets"][0]["NORMAL"] = builder.addPositions({{0, 1, -1}, {0, 0, 0}, {0, 0, 0}});
  builder.primitive()["targets"][0]["TANGENT"] = builder.addPositions({{-1, 0, 1}, {0, 0, 0}, {0, 0, 0}});
  builder.json["meshes"][0]["weights"] = {1};
  const Scene scene = load(builder);
  EXPECT_EQ(unpackNormal(scene.vertices[0].normal), vec3(0, 1, 0));
  EXPECT_EQ(unpackTangent(scene.vertices[0].tangent), vec4(0, 0, 1, -1));
}

TEST(MorphTargets, WithoutAViewTheBaseStays) {
  GltfBuilder builder = morphing();
  builder.json["accessors"].back().erase("bufferView");
  builder.json["meshes"][0]["weights"] = {1};
  EXPECT_EQ(load(builder).positions[2], vec3(0, 1, 0));
}

}  // namespace
}  // namespace importon::test
