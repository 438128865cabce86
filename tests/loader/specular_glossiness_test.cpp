/// KHR_materials_pbrSpecularGlossiness as our own material.
#include <gtest/gtest.h>

#include "loader/image_builder.h"
#include "loader/load.h"

namespace importon::test {
namespace {

constexpr const char* kExtension = "KHR_materials_pbrSpecularGlossiness";

GltfBuilder glossy(const Json& own) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["extensionsUsed"] = {kExtension};
  builder.json["extensionsRequired"] = {kExtension};
  builder.primitive()["attributes"]["TEXCOORD_0"] =
      builder.addAccessor(std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}, kFloat, "VEC2");
  builder.json["materials"][0]["extensions"][kExtension] = own;
  return builder;
}

/// Of the interface at normal incidence, as shaders/lib/bsdf.glsl has it.
vec3 reflectance(const Material& m) {
  const float f = (m.ior - 1) / (m.ior + 1);
  return glm::min(f * f * m.specularColor, vec3(1)) * m.specular;
}

TEST(SpecularGlossiness, FactorsBecomeOurs) {
  GltfBuilder builder = glossy(
      {{"diffuseFactor", {0.5, 0.25, 0.125, 0.75}}, {"specularFactor", {0.9, 0.04, 0}}, {"glossinessFactor", 0.8}});
  builder.json["materials"][0]["pbrMetallicRoughness"] = {{"metallicFactor", 1}, {"roughnessFactor", 1}};
  builder.json["materials"][0]["extensions"]["KHR_materials_ior"]["ior"] = 2;
  const Material m = load(builder).materials.at(0);
  EXPECT_EQ(m.baseColor, vec4(0.5f, 0.25f, 0.125f, 0.75f));
  EXPECT_EQ(m.metallic, 0);
  EXPECT_FLOAT_EQ(m.roughness, 0.2f);
  const vec3 f0 = reflectance(m);
  EXPECT_NEAR(f0.r, 0.9f, 1e-6);
  EXPECT_NEAR(f0.g, 0.04f, 1e-7);
  EXPECT_EQ(f0.b, 0);
}

TEST(SpecularGlossiness, DefaultsAreThoseOfTheExtension) {
  const Material m = load(glossy(Json::object())).materials.at(0);
  EXPECT_EQ(m.baseColor, vec4(1));
  EXPECT_EQ(m.roughness, 0);
  EXPECT_NEAR(reflectance(m).r, 1, 1e-6);
}

TEST(SpecularGlossiness, AlphaOfItsTextureBecomesRoughnessPerTexel) {
  GltfBuilder builder = glossy({{"glossinessFactor", 0.5}});
  // Specular colour and glossiness of two texels.
  const int texture = builder.addTexture(makePng(2, 1, {10, 20, 30, 255, 40, 50, 60, 51}));
  builder.json["materials"][0]["extensions"][kExtension]["specularGlossinessTexture"]["index"] = texture;
  const Scene scene = load(builder);
  const Material& m = scene.materials.at(0);
  EXPECT_EQ(m.roughness, 1);
  const Texture& roughness = scene.textures.at(m.metallicRoughnessTexture);
  const auto green = [&](uint x) { return scene.texels.at(roughness.firstTexel + x) >> 8 & 0xFFu; };
  EXPECT_EQ(green(0), 128u);  // 1 - 0.5
  EXPECT_EQ(green(1), 230u);  // 1 - 0.5 · 0.2 = 0.9
  const Texture& specular = scene.textures.at(m.specularColorTexture);
  EXPECT_EQ(specular.isSrgb, 1u);
  EXPECT_EQ(scene.texels.at(specular.firstTexel) & 0xFFFFFFu, 10u | 20u << 8 | 30u << 16);
}

TEST(SpecularGlossiness, MaterialsOfOtherFactorsGetTexturesOfTheirOwn) {
  GltfBuilder builder = glossy({{"glossinessFactor", 1}});
  const int texture = builder.addTexture(makePng(1, 1, {0, 0, 0, 255}));
  builder.json["materials"][0]["extensions"][kExtension]["specularGlossinessTexture"]["index"] = texture;
  for (const double factor : {1.0, 0.0}) {
    Json other = builder.json["materials"][0];
    other["extensions"][kExtension]["glossinessFactor"] = factor;
    Json primitive = builder.primitive();
    primitive["material"] = builder.add("materials", other);
    builder.addMesh(primitive);
  }
  const Scene scene = load(builder);
  const auto textureOf = [&](std::size_t m) { return scene.materials[m].metallicRoughnessTexture; };
  EXPECT_EQ(textureOf(0), textureOf(1));
  EXPECT_NE(textureOf(0), textureOf(2));
  EXPECT_EQ(scene.texels.at(scene.textures.at(textureOf(0)).firstTexel) >> 8 & 0xFFu, 0u);
  EXPECT_EQ(scene.texels.at(scene.textures.at(textureOf(2)).firstTexel) >> 8 & 0xFFu, 255u);
}

TEST(SpecularGlossiness, IsChecked) {
  GltfBuilder builder = glossy({{"diffuseFactor", {1, 1}}});
  EXPECT_NE(errorOf(builder).find("expected 4 numbers"), std::string::npos) << errorOf(builder);
  builder = glossy({{"diffuseTexture", {{"index", 0}}}});
  EXPECT_NE(errorOf(builder).find("index 0 is not among the 0 textures"), std::string::npos) << errorOf(builder);
}

}  // namespace
}  // namespace importon::test
