#include <gtest/gtest.h>

#include "loader/load.h"
#include "scene/packing.h"

namespace importon::test {
namespace {

glm::dvec3 geometricNormal(const Scene& scene, std::size_t triangle = 0) {
  const Triangle& t = scene.triangles[triangle];
  const vec3 a = scene.positions[t.v0];
  return glm::normalize(glm::dvec3(glm::cross(scene.positions[t.v1] - a, scene.positions[t.v2] - a)));
}

TEST(Hierarchy, TransformsComposeFromParentToChild) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["nodes"][0]["scale"] = {2, 2, 2};
  const double half = std::sqrt(0.5);
  builder.add("nodes", {{"translation", {10, 0, 0}}, {"rotation", {0, 0, half, half}}, {"children", {0}}});
  builder.json["scenes"][0]["nodes"] = {1};
  const Scene scene = load(builder);
  EXPECT_NEAR(scene.positions[1].x, 10, 1e-6);  // (1, 0, 0) to (2, 0, 0) to (0, 2, 0) to (10, 2, 0)
  EXPECT_NEAR(scene.positions[1].y, 2, 1e-6);
}

TEST(Hierarchy, MatrixAndTrsMeanTheSame) {
  GltfBuilder trs = GltfBuilder::emissiveTriangle();
  trs.json["nodes"][0]["translation"] = {1, 2, 3};
  trs.json["nodes"][0]["scale"] = {4, 5, 6};
  GltfBuilder matrix = GltfBuilder::emissiveTriangle();
  matrix.json["nodes"][0]["matrix"] = {4, 0, 0, 0, 0, 5, 0, 0, 0, 0, 6, 0, 1, 2, 3, 1};
  EXPECT_EQ(load(trs).positions, load(matrix).positions);
}

TEST(Hierarchy, RotationsNeedNoUnitLength) {
  GltfBuilder unit = GltfBuilder::emissiveTriangle();
  unit.json["nodes"][0]["rotation"] = {0, 0, 0, 1};
  GltfBuilder longer = GltfBuilder::emissiveTriangle();
  longer.json["nodes"][0]["rotation"] = {0, 0, 0, 5};
  EXPECT_EQ(load(unit).positions, load(longer).positions);
}

TEST(Hierarchy, NegativeScaleKeepsTheFrontOnItsSide) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.primitive()["attributes"]["NORMAL"] = builder.addPositions({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
  builder.primitive()["attributes"]["TANGENT"] =
      builder.addAccessor(std::vector<glm::vec4>{{1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}}, kFloat, "VEC4");
  const Scene upright = load(builder);
  EXPECT_EQ(geometricNormal(upright), glm::dvec3(0, 0, 1));
  EXPECT_EQ(unpackTangent(upright.vertices[0].tangent), vec4(1, 0, 0, 1));

  builder.json["nodes"][0]["scale"] = {-1, 1, 1};
  const Scene mirrored = load(builder);
  EXPECT_EQ(geometricNormal(mirrored), glm::dvec3(0, 0, 1));
  EXPECT_EQ(unpackNormal(mirrored.vertices[0].normal), vec3(0, 0, 1));
  EXPECT_EQ(unpackTangent(mirrored.vertices[0].tangent), vec4(-1, 0, 0, -1));

  builder.json["nodes"][0]["scale"] = {1, 1, -1};
  const Scene flipped = load(builder);
  EXPECT_EQ(geometricNormal(flipped), glm::dvec3(0, 0, -1));
  EXPECT_EQ(unpackNormal(flipped.vertices[0].normal), vec3(0, 0, -1));
}

TEST(Hierarchy, NormalsGoByTheInverseTranspose) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const glm::vec3 slanted = glm::normalize(glm::vec3(1, 1, 0));
  builder.primitive()["attributes"]["NORMAL"] = builder.addPositions({slanted, slanted, slanted});
  builder.json["nodes"][0]["scale"] = {2, 1, 1};
  const vec3 expected = glm::normalize(vec3(0.5f, 1, 0));
  EXPECT_LT(glm::length(unpackNormal(load(builder).vertices[0].normal) - expected), 1e-4f);
}

TEST(Hierarchy, InstancesShareAMeshAtDifferentPlaces) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.addRoot({{"mesh", 0}, {"translation", {0, 0, 5}}});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.triangles.size(), 2u);
  EXPECT_EQ(scene.positions[scene.triangles[0].v0], vec3(0, 0, 0));
  EXPECT_EQ(scene.positions[scene.triangles[1].v0], vec3(0, 0, 5));
}

TEST(Hierarchy, ShowsTheDefaultSceneOnly) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.add("nodes", {{"mesh", 0}});
  builder.add("nodes", {{"mesh", 0}});
  builder.add("scenes", {{"nodes", {1, 2}}});
  EXPECT_EQ(load(builder).triangles.size(), 1u);
  builder.json["scene"] = 1;
  EXPECT_EQ(load(builder).triangles.size(), 2u);
}

TEST(Hierarchy, ShowsAllRootsWhenThereIsNoScene) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.add("nodes", {{"mesh", 0}});
  builder.json.erase("scene");
  builder.json.erase("scenes");
  EXPECT_EQ(load(builder).triangles.size(), 2u);
}

TEST(Hierarchy, RefusesCycles) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.add("nodes", {{"children", {2}}});
  builder.add("nodes", {{"children", {1}}});
  EXPECT_NE(errorOf(builder).find("cycle of nodes or below one (test.glb#/nodes/1)"), std::string::npos);
  GltfBuilder self = GltfBuilder::emissiveTriangle();
  self.json["nodes"][0]["children"] = {0};
  EXPECT_NE(errorOf(self).find("itself for one (test.glb#/nodes/0/children/0)"), std::string::npos);
}

TEST(Hierarchy, RefusesTwoParentsAndDoubledRoots) {
  GltfBuilder parents = GltfBuilder::emissiveTriangle();
  parents.add("nodes", {{"children", {0}}});
  parents.add("nodes", {{"children", {0}}});
  EXPECT_NE(errorOf(parents).find("more than one parent"), std::string::npos);
  GltfBuilder roots = GltfBuilder::emissiveTriangle();
  roots.json["scenes"][0]["nodes"] = {0, 0};
  EXPECT_NE(errorOf(roots, kStrict).find("listed twice"), std::string::npos);
}

TEST(Hierarchy, BearsAHundredThousandLevels) {
  constexpr int kLevels = 100000;
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  Json nodes = Json::array();
  for (int i = 0; i + 1 < kLevels; ++i) nodes.push_back({{"children", {i + 1}}});
  nodes.push_back({{"mesh", 0}});
  nodes[kLevels / 2]["translation"] = {0, 0, 7};
  builder.json["nodes"] = nodes;
  const Scene scene = load(builder);
  EXPECT_EQ(glm::dvec3(scene.positions[0]) + scene.worldFromRender, glm::dvec3(0, 0, 7));
}

/// What moves stands where its node says, whatever an animation makes of it later.
TEST(Hierarchy, AnimationsLeaveThePoseAtRest) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["nodes"][0]["translation"] = {3, 0, 0};
  const int times = builder.addAccessor(std::vector<float>{0, 1}, kFloat, "SCALAR");
  const int places = builder.addPositions({{7, 0, 0}, {8, 0, 0}});
  const int colors = builder.addAccessor(std::vector<glm::vec4>(2), kFloat, "VEC4");
  const Json pointer = {{"pointer", "/materials/0/emissiveFactor"}};
  builder.json["extensionsUsed"] = {"KHR_animation_pointer"};
  builder.json["extensionsRequired"] = {"KHR_animation_pointer"};
  builder.json["animations"] = {
      {{"samplers", {{{"input", times}, {"output", places}}, {{"input", times}, {"output", colors}}}},
       {"channels",
        {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}},
         {{"sampler", 1}, {"target", {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", pointer}}}}}}}}}};
  const Scene scene = load(builder);
  EXPECT_EQ(scene.positions[0].x + static_cast<float>(scene.worldFromRender.x), 3);
  EXPECT_EQ(scene.materials[0].emission, vec3(1, 2, 3));
}

}  // namespace
}  // namespace importon::test
