#include <gtest/gtest.h>

#include "loader/load.h"
#include "scene/packing.h"

namespace importon::test {
namespace {

/// The triangle on two joints: vertices 0 and 1 follow the first, vertex 2 both alike. The joints stand at
/// (10, 0, 0) and (0, 20, 0).
GltfBuilder skinned() {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const int first = builder.addRoot({{"translation", {10, 0, 0}}});
  const int second = builder.addRoot({{"translation", {0, 20, 0}}});
  builder.add("skins", {{"joints", {first, second}}});
  Json& node = builder.json["nodes"][0];
  node["skin"] = 0;
  node["translation"] = {100, 100, 100};  // not used: the joints place the mesh
  builder.primitive()["attributes"]["JOINTS_0"] =
      builder.addAccessor(std::vector<glm::u8vec4>{{0, 1, 0, 0}, {0, 1, 0, 0}, {0, 1, 0, 0}}, kUnsignedByte, "VEC4");
  builder.primitive()["attributes"]["WEIGHTS_0"] =
      builder.addAccessor(std::vector<glm::vec4>{{1, 0, 0, 0}, {2, 0, 0, 0}, {0.5f, 0.5f, 0, 0}}, kFloat, "VEC4");
  return builder;
}

TEST(Skin, PosesTheMeshByItsJoints) {
  Log log(Log::Verbosity::quiet);
  const Scene scene = load(skinned().glb(), log);
  EXPECT_EQ(scene.positions, (std::vector<vec3>{{10, 0, 0}, {11, 0, 0}, {5, 11, 0}}));
  ASSERT_EQ(log.warnings().size(), 1u);
  EXPECT_EQ(log.warnings()[0].kind, "skinned mesh");
}

/// Vertices 0 and 1 follow joint 0; vertex 2 follows four of JOINTS_0 and the second joint in JOINTS_1, all by 0.2.
TEST(Skin, AllSetsOfJointsCount) {
  GltfBuilder builder = skinned();
  Json& attributes = builder.primitive()["attributes"];
  attributes["JOINTS_0"] = builder.addAccessor(std::vector<glm::u8vec4>(3, {0, 0, 0, 0}), kUnsignedByte, "VEC4");
  attributes["WEIGHTS_0"] =
      builder.addAccessor(std::vector<glm::vec4>{{1, 0, 0, 0}, {1, 0, 0, 0}, {0.2f, 0.2f, 0.2f, 0.2f}}, kFloat, "VEC4");
  attributes["JOINTS_1"] = builder.addAccessor(std::vector<glm::u16vec4>(3, {1, 0, 0, 0}), kUnsignedShort, "VEC4");
  attributes["WEIGHTS_1"] = builder.addAccessor(std::vector<glm::vec4>{{}, {}, {0.2f, 0, 0, 0}}, kFloat, "VEC4");
  const Scene scene = load(builder);
  ASSERT_EQ(scene.positions.size(), 3u);
  EXPECT_EQ(scene.positions[1], vec3(11, 0, 0));
  EXPECT_NEAR(scene.positions[2].x, 8, 1e-5);
  EXPECT_NEAR(scene.positions[2].y, 5, 1e-5);
  attributes["JOINTS_1"] = builder.addAccessor(std::vector<glm::u16vec4>(3, {2, 0, 0, 0}), kUnsignedShort, "VEC4");
  EXPECT_NE(errorOf(builder).find("joint 2 of a vertex is not among the 2"), std::string::npos);
  attributes.erase("JOINTS_1");
  EXPECT_NE(errorOf(builder, kStrict).find("JOINTS_1 is missing"), std::string::npos);
}

TEST(Skin, InverseBindMatricesUndoTheBindPose) {
  GltfBuilder builder = skinned();
  const auto back = [](const glm::vec3& by) {
    glm::mat4 matrix(1.0f);
    matrix[3] = glm::vec4(-by, 1);
    return matrix;
  };
  builder.json["skins"][0]["inverseBindMatrices"] =
      builder.addAccessor(std::vector<glm::mat4>{back({10, 0, 0}), back({0, 20, 0})}, kFloat, "MAT4");
  EXPECT_EQ(load(builder).positions, (std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST(Skin, MirroringJointsKeepTheFrontOnItsSide) {
  GltfBuilder builder = skinned();
  builder.primitive()["attributes"]["NORMAL"] = builder.addPositions({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
  for (const int joint : {1, 2}) builder.json["nodes"][joint]["scale"] = {-1, 1, 1};
  const Scene scene = load(builder);
  const Triangle& t = scene.triangles[0];
  const vec3 a = scene.positions[t.v0];
  EXPECT_GT(glm::cross(scene.positions[t.v1] - a, scene.positions[t.v2] - a).z, 0);
  EXPECT_EQ(unpackNormal(scene.vertices[0].normal), vec3(0, 0, 1));
}

TEST(Skin, RefusesWhatDoesNotFit) {
  GltfBuilder outside = skinned();
  outside.json["scenes"][0]["nodes"] = {0, 1};
  EXPECT_NE(errorOf(outside).find("the joint is not in the scene (test.glb#/skins/0/joints/1)"), std::string::npos);
  GltfBuilder joint = skinned();
  joint.json["skins"][0]["joints"] = {1};
  EXPECT_NE(errorOf(joint).find("joint 1 of a vertex is not among the 1"), std::string::npos);
  GltfBuilder weights = skinned();
  weights.primitive()["attributes"].erase("WEIGHTS_0");
  EXPECT_NE(errorOf(weights, kStrict).find("WEIGHTS_0 is missing"), std::string::npos);
  GltfBuilder matrices = skinned();
  matrices.json["skins"][0]["inverseBindMatrices"] =
      matrices.addAccessor(std::vector<glm::mat4>{glm::mat4(1.0f)}, kFloat, "MAT4");
  EXPECT_NE(errorOf(matrices).find("2 joints have 1 inverse bind matrices"), std::string::npos);
  GltfBuilder vectors = skinned();
  vectors.json["skins"][0]["inverseBindMatrices"] = 0;
  EXPECT_NE(errorOf(vectors).find("does not hold matrices"), std::string::npos);
}

}  // namespace
}  // namespace importon::test
