/// What is told of a file's animations.
#include <gtest/gtest.h>

#include "loader/animation_builder.h"
#include "loader/load.h"

namespace importon::test {
namespace {

Scene listed(const GltfBuilder& builder, Log& log) {
  return loadGltfFromMemory(asBytes(builder.glb()), "test.glb", {}, log, {.listsAnimations = true});
}

Scene listed(const GltfBuilder& builder) {
  Log log(Log::Verbosity::quiet);
  return listed(builder, log);
}

GltfBuilder walkAndOther() {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  addMove(builder, 0, {0, 0, 0}, {1, 0, 0});
  addChannel(builder, addSampler<glm::vec4>(builder, {0, 2.5F}, {{0, 0, 0, 1}, {0, 0, 0, 1}}, "VEC4"), 0, "rotation");
  addMove(builder, 0, {0, 0, 0}, {1, 0, 0}, 1);
  addPointer(builder, addSampler<float>(builder, {0, 0.5F}, {0, 1}, "SCALAR", "LINEAR", 1),
             "/materials/0/pbrMetallicRoughness/roughnessFactor", 1);
  builder.json["animations"][0]["name"] = "walk";
  return builder;
}

TEST(AnimationList, HasNamesLengthsAndChannelsByKind) {
  const Scene scene = listed(walkAndOther());
  ASSERT_EQ(scene.animations.size(), 2u);
  EXPECT_EQ(scene.animations[0].name, "walk");
  EXPECT_EQ(scene.animations[0].duration, 2.5);
  EXPECT_EQ(scene.animations[0].channels, (std::map<std::string, std::size_t>{{"translation", 1}, {"rotation", 1}}));
  EXPECT_EQ(scene.animations[1].name, "");
  EXPECT_EQ(scene.animations[1].duration, 1);
  EXPECT_EQ(scene.animations[1].channels, (std::map<std::string, std::size_t>{{"translation", 1}, {"pointer", 1}}));
}

TEST(AnimationList, IsEmptyWhereItIsNotAskedForOrThereIsNone) {
  EXPECT_TRUE(load(walkAndOther()).animations.empty());
  Log log(Log::Verbosity::quiet);
  EXPECT_TRUE(listed(GltfBuilder::emissiveTriangle(), log).animations.empty());
  EXPECT_TRUE(log.warnings().empty());
}

TEST(AnimationList, WarnsOfWhatIsBrokenAndGoesOn) {
  GltfBuilder builder = walkAndOther();
  addSampler<glm::vec3>(builder, {1, 0}, {{0, 0, 0}, {1, 0, 0}}, "VEC3");  // times that fall
  Log log(Log::Verbosity::quiet);
  const Scene scene = listed(builder, log);
  ASSERT_EQ(scene.animations.size(), 2u);
  EXPECT_FALSE(scene.animations[0].duration);
  EXPECT_EQ(scene.animations[1].duration, 1);
  ASSERT_EQ(log.warnings().size(), 1u);
  EXPECT_EQ(log.warnings()[0].kind, "broken animation");

  builder.json["animations"][1]["channels"] = "none";
  Log other(Log::Verbosity::quiet);
  EXPECT_TRUE(listed(builder, other).animations.empty());
  ASSERT_EQ(other.warnings().size(), 1u);
  EXPECT_EQ(other.warnings()[0].kind, "broken animation");
}

}  // namespace
}  // namespace importon::test
