/// EXT_mesh_gpu_instancing and KHR_node_visibility: how often a node's mesh is drawn.
#include <gtest/gtest.h>

#include "loader/load.h"

namespace importon::test {
namespace {

/// The triangle with these attributes of instances.
GltfBuilder instanced(const std::function<Json(GltfBuilder&)>& attributes) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  builder.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  const Json made = attributes(builder);
  builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = made;
  return builder;
}

void expectNear(const vec3& a, const vec3& b) {
  EXPECT_LT(glm::length(a - b), 1e-4f) << a.x << " " << a.y << " " << a.z;
}

TEST(Instancing, EachInstanceIsDrawn) {
  const Scene scene = load(instanced([](GltfBuilder& b) {
    return Json{{"TRANSLATION", b.addPositions({{0, 0, 0}, {10, 0, 0}})},
                {"SCALE", b.addPositions({{1, 1, 1}, {2, 2, 2}})}};
  }));
  ASSERT_EQ(scene.triangles.size(), 2u);
  expectNear(scene.positions[4], {12, 0, 0});  // (1, 0, 0) twice as far, then moved
  EXPECT_EQ(scene.lights.size(), 2u);
}

TEST(Instancing, TheNodeMovesItsInstances) {
  GltfBuilder builder = instanced([](GltfBuilder& b) { return Json{{"TRANSLATION", b.addPositions({{1, 0, 0}})}}; });
  builder.json["nodes"][0]["scale"] = {3, 3, 3};
  expectNear(load(builder).positions[0], {3, 0, 0});
}

TEST(Instancing, RotationsMayBeNormalisedIntegers) {
  const Scene scene = load(instanced([](GltfBuilder& b) {
    // A quarter turn about z: (0, 0, sin 45°, cos 45°).
    const int rotation = b.addAccessor(std::vector<glm::i16vec4>{{0, 0, 23170, 23170}}, kShort, "VEC4");
    b.json["accessors"][rotation]["normalized"] = true;
    return Json{{"ROTATION", rotation}};
  }));
  expectNear(scene.positions[1], {0, 1, 0});
}

TEST(Instancing, OtherAttributesArePassedOver) {
  const Scene scene = load(instanced([](GltfBuilder& b) { return Json{{"_ID", b.addPositions({{1, 0, 0}})}}; }));
  EXPECT_EQ(scene.triangles.size(), 1u);
}

TEST(Instancing, AttributesAreOfOneLength) {
  const GltfBuilder builder = instanced([](GltfBuilder& b) {
    return Json{{"TRANSLATION", b.addPositions({{0, 0, 0}, {1, 0, 0}})}, {"SCALE", b.addPositions({{1, 1, 1}})}};
  });
  EXPECT_NE(errorOf(builder).find("SCALE has 1 elements but others have 2"), std::string::npos) << errorOf(builder);
}

TEST(Instancing, InstancesWithoutEndAreRefused) {
  const GltfBuilder builder = instanced([](GltfBuilder& b) {
    return Json{{"TRANSLATION", b.add("accessors", {{"componentType", kFloat}, {"count", 1 << 23}, {"type", "VEC3"}})}};
  });
  EXPECT_NE(errorOf(builder).find("instances are more than"), std::string::npos) << errorOf(builder);
}

/// A triangle that is seen, and one of emission 5 below a node that is hidden or not, with a light.
GltfBuilder hidden(bool isVisible) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({{{"type", "point"}}});
  const int child = builder.add("nodes", {{"mesh", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  builder.addRoot({{"children", {child}}, {"extensions", {{"KHR_node_visibility", {{"visible", isVisible}}}}}});
  return builder;
}

TEST(Visibility, NothingBelowAHiddenNodeIsDrawnNorLights) {
  const Scene seen = load(hidden(true));
  EXPECT_EQ(seen.triangles.size(), 2u);
  EXPECT_EQ(seen.lights.size(), 3u);
  const Scene unseen = load(hidden(false));
  EXPECT_EQ(unseen.triangles.size(), 1u);
  EXPECT_EQ(unseen.lights.size(), 1u);
}

TEST(Visibility, AVisibleChildOfAHiddenNodeIsHidden) {
  GltfBuilder builder = hidden(false);
  builder.json["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = true;
  EXPECT_EQ(load(builder).triangles.size(), 1u);
}

}  // namespace
}  // namespace importon::test
