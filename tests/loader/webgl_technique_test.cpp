/// KHR_techniques_webgl: materials that are programs.
#include <gtest/gtest.h>

#include "loader/image_builder.h"
#include "loader/load.h"

namespace importon::test::webgl_technique_test {
namespace {

constexpr const char* kTechnique = "KHR_techniques_webgl";

GltfBuilder withValues(const Json& values) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {kTechnique};
  builder.json["materials"][0].erase("pbrMetallicRoughness");
  builder.json["materials"][0]["extensions"][kTechnique] = {{"technique", 0}, {"values", values}};
  return builder;
}

TEST(WebglTechnique, GivesAMatteMaterialOfItsDiffuseColor) {
  const Material material = load(withValues({{"u_Diffuse", {0.2, 0.5, 7}}, {"u_shininess", 256}})).materials.at(0);
  EXPECT_EQ(material.baseColor, vec4(0.2f, 0.5f, 1, 1));
  EXPECT_EQ(material.metallic, 0);
  EXPECT_EQ(material.roughness, 1);
}

TEST(WebglTechnique, GivesItsDiffuseTexture) {
  GltfBuilder builder = withValues({{"u_diffuse", {{"index", 0}, {"texCoord", 1}}}});
  builder.addTexture(makePng(1, 1, {1, 2, 3, 4}));
  const Scene scene = load(builder);
  ASSERT_NE(scene.materials.at(0).baseColorTexture, kNone);
  EXPECT_EQ(scene.textures.at(0).uvSet, 1u);
}

/// The values are the program's own: whatever they are, the material is white at least.
TEST(WebglTechnique, OtherValuesLeaveItWhite) {
  for (const Json& values :
       {Json(nullptr), Json(3), Json::object(), Json{{"diffuse", "red"}}, Json{{"diffuse", {1, 2}}},
        Json{{"diffuse", {{"index", 0}}}}, Json{{"diffuse", {1, "a", 2}}}, Json{{"diffuse", {{"index", -1}}}}}) {
    EXPECT_EQ(load(withValues(values)).materials.at(0).baseColor, vec4(1)) << values;
  }
}

TEST(WebglTechnique, IsSaidOnceAndGivesWayToAMaterialOfGltf) {
  GltfBuilder builder = withValues({{"u_diffuse", {0, 0, 0, 1}}});
  const std::vector<Warning> warnings = warningsOf(builder);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].kind, "material by a program");
  EXPECT_NE(errorOf(builder, kStrict).find("program of WebGL (test.glb#/materials/0/extensions/"), std::string::npos);
  builder.json["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = 0.5;
  EXPECT_EQ(warningsOf(builder).size(), 0u);
  EXPECT_EQ(load(builder).materials.at(0).metallic, 0.5f);
}

}  // namespace
}  // namespace importon::test::webgl_technique_test
