/// Scenes and variants of materials that a user chooses.
#include <gtest/gtest.h>

#include "loader/load.h"

namespace importon::test {
namespace {

/// Scene 0 "first" shows the triangle at 0, scene 1 "second" at x = 5.
GltfBuilder twoScenes() {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["scenes"][0]["name"] = "first";
  const int node = builder.add("nodes", {{"mesh", 0}, {"translation", {5, 0, 0}}});
  builder.add("scenes", {{"name", "second"}, {"nodes", {node}}});
  return builder;
}

float firstX(const Scene& scene) { return scene.positions[0].x + static_cast<float>(scene.worldFromRender.x); }

TEST(SceneChoice, IsByNameOrIndex) {
  EXPECT_EQ(firstX(load(twoScenes())), 0);
  EXPECT_EQ(firstX(load(twoScenes(), {.scene = "second"})), 5);
  EXPECT_EQ(firstX(load(twoScenes(), {.scene = "1"})), 5);
  EXPECT_EQ(firstX(load(twoScenes(), {.scene = "first"})), 0);
}

TEST(SceneChoice, ADefaultInTheFileGivesWayToIt) {
  GltfBuilder builder = twoScenes();
  builder.json["scene"] = 1;
  EXPECT_EQ(firstX(load(builder)), 5);
  EXPECT_EQ(firstX(load(builder, {.scene = "0"})), 0);
}

TEST(SceneChoice, TheFirstOfEqualNamesIsMeant) {
  GltfBuilder builder = twoScenes();
  builder.json["scenes"][1]["name"] = "first";
  EXPECT_EQ(firstX(load(builder, {.scene = "first"})), 0);
}

std::string usageErrorOf(const GltfBuilder& builder, const FileChoices& choices) {
  try {
    (void)load(builder, choices);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(SceneChoice, NamesThoseThatThereAre) {
  const std::string error = usageErrorOf(twoScenes(), {.scene = "third"});
  EXPECT_NE(error.find("no scene 'third' (--scene): use one of: 0 first, 1 second"), std::string::npos) << error;
  EXPECT_NE(usageErrorOf(twoScenes(), {.scene = "2"}), "");
  EXPECT_NE(usageErrorOf(twoScenes(), {.scene = "-1"}), "");
}

constexpr const char* kVariants = "KHR_materials_variants";

/// The triangle emits (1, 2, 3), in the variant "blue" (0, 0, 7), in "white" (9, 9, 9); "bare" maps nothing.
GltfBuilder threeVariants() {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["extensionsUsed"] = {kVariants};
  builder.json["extensionsRequired"] = {kVariants};
  builder.json["extensions"][kVariants]["variants"] = {{{"name", "blue"}}, {{"name", "white"}}, {{"name", "bare"}}};
  const int blue = builder.add("materials", {{"emissiveFactor", {0, 0, 7}}});
  const int white = builder.add("materials", {{"emissiveFactor", {9, 9, 9}}});
  builder.primitive()["extensions"][kVariants]["mappings"] = {{{"material", blue}, {"variants", {0}}},
                                                              {{"material", white}, {"variants", {1}}}};
  return builder;
}

vec3 emissionOf(const Scene& scene) { return scene.materials[scene.triangles[0].material].emission; }

TEST(Variant, GivesPrimitivesItsMaterials) {
  EXPECT_EQ(emissionOf(load(threeVariants())), vec3(1, 2, 3));
  EXPECT_EQ(emissionOf(load(threeVariants(), {.variant = "blue"})), vec3(0, 0, 7));
  EXPECT_EQ(emissionOf(load(threeVariants(), {.variant = "white"})), vec3(9));
  EXPECT_EQ(emissionOf(load(threeVariants(), {.variant = "bare"})), vec3(1, 2, 3));
}

TEST(Variant, NamesThoseThatThereAre) {
  const std::string error = usageErrorOf(threeVariants(), {.variant = "red"});
  EXPECT_NE(error.find("no variant 'red' (--variant): use one of: 0 blue, 1 white, 2 bare"), std::string::npos)
      << error;
  const std::string none = usageErrorOf(GltfBuilder::emissiveTriangle(), {.variant = "red"});
  EXPECT_NE(none.find("the file has no variant"), std::string::npos) << none;
}

TEST(Variant, MappingsAreChecked) {
  GltfBuilder builder = threeVariants();
  builder.primitive()["extensions"][kVariants]["mappings"][0]["material"] = 9;
  EXPECT_NE(errorOf(builder).find("index 9 is not among the 3 materials"), std::string::npos);
  builder.primitive()["extensions"][kVariants]["mappings"][0] = {{"material", 0}, {"variants", {3}}};
  EXPECT_NE(errorOf(builder).find("index 3 is not among the 3"), std::string::npos);
}

}  // namespace
}  // namespace importon::test
