/// Poses of animated files.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "loader/animation_builder.h"
#include "loader/load.h"
#include "scene/animation/gltf_animation.h"

namespace importon::test {
namespace {

vec3 corner(const Scene& scene, std::size_t vertex = 0) {
  return scene.positions[vertex] + vec3(scene.worldFromRender);
}

Scene loadAt(const GltfBuilder& builder, double seconds) { return load(builder, {.at = seconds}); }

std::vector<Warning> warningsAt(const GltfBuilder& builder, double seconds) {
  Log log(Log::Verbosity::quiet);
  (void)load(builder.glb(), log, {.at = seconds});
  return log.warnings();
}

void expectNear(const vec3& found, const vec3& expected) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-6) << "axis " << c;
}

TEST(Animation, MovesTurnsAndScalesANode) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  addMove(builder, 0, {1, 0, 0}, {3, 0, 4});
  const auto half = static_cast<float>(std::sqrt(0.5));
  addChannel(builder, addSampler<glm::vec4>(builder, {0, 1}, {{0, 0, 0, 1}, {0, 0, half, half}}, "VEC4"), 0,
             "rotation");
  addChannel(builder, addSampler<glm::vec3>(builder, {0, 1}, {{1, 1, 1}, {3, 1, 1}}, "VEC3"), 0, "scale");
  const Scene scene = loadAt(builder, 0.5);
  expectNear(corner(scene, 0), {2, 0, 2});
  expectNear(corner(scene, 1), {2 + 2 * half, 2 * half, 2});  // twice as long, turned by 45 degrees
  EXPECT_EQ(warningsAt(builder, 0.5).size(), 0u);
  EXPECT_EQ(corner(load(builder)), vec3(0)) << "without a time the pose is that at rest";
}

TEST(Animation, ChildrenFollow) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const int parent = builder.add("nodes", {{"children", {0}}});
  builder.json["scenes"][0]["nodes"] = {parent};
  addMove(builder, parent, {0, 0, 0}, {8, 0, 0});
  addMove(builder, 0, {0, 0, 0}, {0, 4, 0});
  expectNear(corner(loadAt(builder, 0.25)), {2, 1, 0});
}

TEST(Animation, CamerasAndLightsFollowTheirNodes) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
  const int camera = builder.addRoot({{"camera", 0}});
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({{{"type", "point"}}});
  const int light = builder.addRoot({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  addMove(builder, camera, {0, 0, 1}, {0, 0, 5});
  addMove(builder, light, {0, 2, 0}, {6, 2, 0});
  const Scene scene = loadAt(builder, 0.5);
  EXPECT_EQ(glm::dvec3(scene.cameras.at(0).worldFromCamera[3]), glm::dvec3(0, 0, 3));
  ASSERT_EQ(scene.lights.size(), 2u);
  expectNear(scene.lights[1].position + vec3(scene.worldFromRender), {3, 2, 0});
}

TEST(Animation, JointsMoveSkinnedMeshes) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const int joint = builder.addRoot({{"translation", {10, 0, 0}}});
  builder.add("skins", {{"joints", {joint}}});
  builder.json["nodes"][0]["skin"] = 0;
  builder.primitive()["attributes"]["JOINTS_0"] =
      builder.addAccessor(std::vector<glm::u8vec4>(3), kUnsignedByte, "VEC4");
  builder.primitive()["attributes"]["WEIGHTS_0"] =
      builder.addAccessor(std::vector<glm::vec4>(3, {1, 0, 0, 0}), kFloat, "VEC4");
  addMove(builder, joint, {20, 0, 0}, {40, 0, 0});
  expectNear(corner(loadAt(builder, 0.5)), {30, 0, 0});
  expectNear(corner(load(builder)), {10, 0, 0});
  EXPECT_EQ(warningsAt(builder, 0.5).size(), 0u) << "the mesh is posed as its author means";
}

/// Two targets, which lift vertex 2 along z and x.
GltfBuilder morphed() {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.primitive()["targets"] = Json::array({{{"POSITION", builder.addPositions({{}, {}, {0, 0, 4}})}},
                                                {{"POSITION", builder.addPositions({{}, {}, {8, 0, 0}})}}});
  return builder;
}

TEST(Animation, WeightsMorphMeshes) {
  GltfBuilder builder = morphed();
  addChannel(builder, addSampler<float>(builder, {0, 1}, {0, 1, 1, 0.5f}, "SCALAR"), 0, "weights");
  expectNear(corner(loadAt(builder, 0), 2), {8, 1, 0});
  expectNear(corner(loadAt(builder, 0.5), 2), {6, 1, 2});
  expectNear(corner(loadAt(builder, 7), 2), {4, 1, 4});
}

/// Each key has the in-tangents of both, then the values, then the out-tangents.
TEST(Animation, WeightsFollowSplines) {
  GltfBuilder builder = morphed();
  const std::vector<float> keys{9, 9, 0, 1, 0, 4, 0, 0, 1, 1, 9, 9};
  addChannel(builder, addSampler<float>(builder, {0, 2}, keys, "SCALAR", "CUBICSPLINE"), 0, "weights");
  // The middle of two seconds: half of both values, and 2 · (4 - 0) / 8 of the second's slopes.
  expectNear(corner(loadAt(builder, 1), 2), {8 * 2, 1, 4 * 0.5});
}

TEST(Animation, NodesOfAMeshHaveWeightsOfTheirOwn) {
  GltfBuilder builder = morphed();
  const int other = builder.addRoot({{"mesh", 0}});
  addChannel(builder, addSampler<float>(builder, {0}, {1, 0}, "SCALAR"), other, "weights");
  const Scene scene = loadAt(builder, 0);
  expectNear(corner(scene, scene.triangles[0].v2), {0, 1, 0});
  expectNear(corner(scene, scene.triangles[1].v2), {0, 1, 4});
}

/// The same turn by 90 degrees about z, as each type that rotations may have.
TEST(Animation, ReadsRotationsOfAllFiveTypes) {
  const auto cornerOf = [](auto one, int componentType) {
    GltfBuilder builder = GltfBuilder::emissiveTriangle();
    using Vector = glm::vec<4, decltype(one)>;
    const int sampler = addSampler<float>(builder, {0}, {0}, "SCALAR");
    const int output = builder.addAccessor(std::vector<Vector>{Vector(0, 0, one, one)}, componentType, "VEC4");
    builder.json["accessors"][output]["normalized"] = componentType != kFloat;
    builder.json["animations"][0]["samplers"][0]["output"] = output;
    addChannel(builder, sampler, 0, "rotation");
    EXPECT_EQ(warningsAt(builder, 0).size(), 0u);
    return corner(loadAt(builder, 0), 1);
  };
  expectNear(cornerOf(1.0f, kFloat), {0, 1, 0});
  expectNear(cornerOf(std::int8_t{90}, kByte), {0, 1, 0});
  expectNear(cornerOf(std::uint8_t{180}, kUnsignedByte), {0, 1, 0});
  expectNear(cornerOf(std::int16_t{23170}, kShort), {0, 1, 0});
  expectNear(cornerOf(std::uint16_t{46341}, kUnsignedShort), {0, 1, 0});
}

TEST(Animation, IntegersOfWeightsAreNormalised) {
  const auto lift = [](auto value, int componentType, bool saysSo) {
    GltfBuilder builder = morphed();
    const int sampler = addSampler<float>(builder, {0}, {0}, "SCALAR");
    const int output = builder.addAccessor(std::vector{value, decltype(value){0}}, componentType, "SCALAR");
    if (saysSo) builder.json["accessors"][output]["normalized"] = true;
    builder.json["animations"][0]["samplers"][0]["output"] = output;
    addChannel(builder, sampler, 0, "weights");
    EXPECT_EQ(warningsAt(builder, 0).size(), saysSo ? 0u : 1u);
    return corner(loadAt(builder, 0), 2).z / 4;
  };
  for (const bool saysSo : {true, false}) {
    EXPECT_FLOAT_EQ(lift(std::int8_t{-128}, kByte, saysSo), -1);
    EXPECT_FLOAT_EQ(lift(std::uint8_t{51}, kUnsignedByte, saysSo), 0.2f);
    EXPECT_FLOAT_EQ(lift(std::int16_t{32767}, kShort, saysSo), 1);
    EXPECT_FLOAT_EQ(lift(std::uint16_t{13107}, kUnsignedShort, saysSo), 0.2f);
  }
}

/// "far" moves the triangle along x, "up" along y; both turn another property in turn.
GltfBuilder twoAnimations() {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  addMove(builder, 0, {2, 0, 0}, {4, 0, 0}, 0);
  addChannel(builder, addSampler<glm::vec3>(builder, {0}, {{5, 5, 5}}, "VEC3", "STEP", 1), 0, "scale", 1);
  builder.json["animations"][0]["name"] = "far";
  builder.json["animations"][1]["name"] = "large";
  return builder;
}

TEST(Animation, AllPlayAtOnceUnlessOneIsChosen) {
  const GltfBuilder builder = twoAnimations();
  const auto first = [&](const std::string& name) { return corner(load(builder, {.at = 1.0, .animation = name}), 1); };
  expectNear(first(""), {9, 0, 0});
  expectNear(first("far"), {5, 0, 0});
  expectNear(first("large"), {5, 0, 0});
  expectNear(first("1"), {5, 0, 0});
  expectNear(corner(load(builder, {.at = 0.0, .animation = "0"}), 1), {3, 0, 0});
  try {
    (void)first("none");
    ADD_FAILURE() << "an animation that is not there is a usage error";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("no animation 'none' (--animation): use one of: 0 far, 1 large"),
              std::string::npos)
        << error.what();
  }
}

TEST(Animation, OfTwoThatMoveTheSameTheLastCounts) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  addMove(builder, 0, {1, 0, 0}, {1, 0, 0}, 0);
  addMove(builder, 0, {2, 0, 0}, {2, 0, 0}, 1);
  expectNear(corner(loadAt(builder, 0)), {2, 0, 0});
  ASSERT_EQ(warningsAt(builder, 0).size(), 1u);
  EXPECT_EQ(warningsAt(builder, 0)[0].kind, "moved twice");
}

TEST(Animation, PointersMoveMaterialsLightsCamerasAndVisibility) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
  builder.addRoot({{"camera", 0}});
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({{{"type", "point"}}});
  builder.addRoot({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  const int hidden = builder.addRoot({{"mesh", 0}, {"extensions", {{"KHR_node_visibility", {{"visible", true}}}}}});
  const auto number = [&](float from, float to) { return addSampler<float>(builder, {0, 1}, {from, to}, "SCALAR"); };
  addPointer(builder, addSampler<glm::vec3>(builder, {0, 1}, {{0, 0, 0}, {1, 1, 0}}, "VEC3"),
             "/materials/0/emissiveFactor");
  addPointer(builder, number(0, 1), "/materials/0/pbrMetallicRoughness/roughnessFactor");
  addPointer(builder, number(1, 2), "/cameras/0/perspective/yfov");
  addPointer(builder, number(10, 30), "/extensions/KHR_lights_punctual/lights/0/intensity");
  addPointer(builder, number(1, 0), fmt::format("/nodes/{}/extensions/KHR_node_visibility/visible", hidden));
  builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"KHR_animation_pointer"};
  const Scene scene = loadAt(builder, 0.5), end = loadAt(builder, 1);
  EXPECT_EQ(scene.materials[0].emission.y / end.materials[0].emission.y, 0.5f);
  EXPECT_EQ(scene.materials[0].roughness, 0.5f);
  EXPECT_EQ(scene.cameras[0].yfov, 1.5);
  EXPECT_EQ(scene.lights.back().emission, vec3(20));
  EXPECT_EQ(scene.triangles.size(), 2u) << "booleans step";
  EXPECT_EQ(end.triangles.size(), 1u);
  EXPECT_EQ(warningsAt(builder, 0.5).size(), 0u);
}

TEST(Animation, SplinesLeadNoNumberOutOfItsRange) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  addPointer(builder, addSampler<float>(builder, {0, 1}, {0, 1, 9, -9, 1, 0}, "SCALAR", "CUBICSPLINE"),
             "/materials/0/pbrMetallicRoughness/roughnessFactor");
  EXPECT_EQ(loadAt(builder, 0.5).materials[0].roughness, 1);
}

TEST(Animation, PointersToWhatIsNotThereArePassedOver) {
  for (const char* pointer :
       {"", "/", "materials", "/materials/0", "/materials/1/emissiveFactor", "/materials/-1/emissiveFactor",
        "/materials/0/name", "/nodes/0/mesh", "/nodes/0/matrix", "/materials/0/extras/x", "/asset/version",
        "/materials/0/extensions/KHR_materials_clearcoat/clearcoatFactor", "/accessors/0/count",
        "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/offset", "/nodes/~0/scale",
        "/cameras/0/perspective/yfov", "/materials/00/emissiveFactor", "/nodes/99999999999999999999/scale"}) {
    GltfBuilder builder = GltfBuilder::emissiveTriangle();
    addPointer(builder, addSampler<float>(builder, {0}, {1}, "SCALAR"), pointer);
    addPointer(builder, 0, pointer);
    const std::vector<Warning> warnings = warningsAt(builder, 0);
    ASSERT_EQ(warnings.size(), 1u) << pointer;
    EXPECT_EQ(warnings[0].kind, "animation of what is not known");
    EXPECT_EQ(warnings[0].count, 2u);
  }
}

TEST(Animation, AFileWithoutOneIsShownAtRestWithAWarning) {
  const std::vector<Warning> warnings = warningsAt(GltfBuilder::emissiveTriangle(), 1);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].kind, "no animation");
}

TEST(Animation, ReadsKeysThatAreSparse) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  addMove(builder, 0, {0, 0, 0}, {2, 0, 0});
  const std::uint8_t place = 1;
  const glm::vec3 value(0, 6, 0);
  Json& output = builder.json["accessors"].back();
  output.erase("bufferView");
  output["sparse"] = {{"count", 1},
                      {"indices", {{"bufferView", builder.addView(&place, 1)}, {"componentType", kUnsignedByte}}},
                      {"values", {{"bufferView", builder.addView(&value, sizeof value)}}}};
  expectNear(corner(loadAt(builder, 0.5)), {0, 3, 0});
}

}  // namespace
}  // namespace importon::test
