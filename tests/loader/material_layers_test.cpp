// Extensions of the material that add lobes: their factors and textures.
#include <gtest/gtest.h>

#include "loader/image_builder.h"
#include "loader/load.h"
#include "scene/packing.h"

namespace importon::test::layers_test {
namespace {

constexpr const char* kLayers = "KHR_materials_";

TEST(MaterialLayers, AreAbsentByDefault) {
  const Material material = materialWith([](Json&) {});
  EXPECT_EQ(material.diffuseTransmission, 0);
  EXPECT_EQ(material.sheenColor, vec3(0));
  EXPECT_EQ(material.anisotropy, 0);
  EXPECT_EQ(material.iridescence, 0);
  EXPECT_EQ(material.dispersion, 0);
  EXPECT_EQ(material.thickness, 0);
  // What stands in for values that a file leaves out.
  EXPECT_EQ(material.diffuseTransmissionColor, vec3(1));
  EXPECT_EQ(material.iridescenceIor, 1.3f);
  EXPECT_EQ(material.iridescenceThicknessMinimum, 100);
  EXPECT_EQ(material.iridescenceThicknessMaximum, 400);
}

TEST(MaterialLayers, HaveTheFactorsOfTheFile) {
  const Material material = materialWith([](Json& json) {
    Json& extensions = json["extensions"];
    extensions["KHR_materials_diffuse_transmission"] = {{"diffuseTransmissionFactor", 0.25},
                                                        {"diffuseTransmissionColorFactor", {0.1, 0.2, 0.3}}};
    extensions["KHR_materials_sheen"] = {{"sheenColorFactor", {0.4, 0.5, 0.6}}, {"sheenRoughnessFactor", 0.7}};
    extensions["KHR_materials_anisotropy"] = {{"anisotropyStrength", 0.8}, {"anisotropyRotation", -7}};
    extensions["KHR_materials_iridescence"] = {{"iridescenceFactor", 0.9},
                                               {"iridescenceIor", 1.8},
                                               {"iridescenceThicknessMinimum", 200},
                                               {"iridescenceThicknessMaximum", 150}};  // may be below
    extensions["KHR_materials_dispersion"] = {{"dispersion", 2}};
    extensions["KHR_materials_volume"] = {{"thicknessFactor", 3}};
  });
  EXPECT_EQ(material.diffuseTransmission, 0.25f);
  EXPECT_EQ(material.diffuseTransmissionColor, vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(material.sheenColor, vec3(0.4f, 0.5f, 0.6f));
  EXPECT_EQ(material.sheenRoughness, 0.7f);
  EXPECT_EQ(material.anisotropy, 0.8f);
  EXPECT_EQ(material.anisotropyRotation, -7);
  EXPECT_EQ(material.iridescence, 0.9f);
  EXPECT_EQ(material.iridescenceIor, 1.8f);
  EXPECT_EQ(material.iridescenceThicknessMinimum, 200);
  EXPECT_EQ(material.iridescenceThicknessMaximum, 150);
  EXPECT_EQ(material.dispersion, 2);
  EXPECT_EQ(material.thickness, 3);
}

struct LayerTexture {
  std::string extension, factor, key;
  uint Material::*field;
  bool isSrgb = false;
};

/// Colours are sRGB; and where the factor is 0 the texture is not read.
TEST(MaterialLayers, ReadTexturesWhereTheFactorAsksForThem) {
  using M = Material;
  const std::vector<LayerTexture> textures{
      {"diffuse_transmission", "diffuseTransmissionFactor", "diffuseTransmissionTexture",
       &M::diffuseTransmissionTexture},
      {"diffuse_transmission", "diffuseTransmissionFactor", "diffuseTransmissionColorTexture",
       &M::diffuseTransmissionColorTexture, true},
      {"sheen", "sheenColorFactor", "sheenColorTexture", &M::sheenColorTexture, true},
      {"sheen", "sheenColorFactor", "sheenRoughnessTexture", &M::sheenRoughnessTexture},
      {"anisotropy", "anisotropyStrength", "anisotropyTexture", &M::anisotropyTexture},
      {"iridescence", "iridescenceFactor", "iridescenceTexture", &M::iridescenceTexture},
      {"iridescence", "iridescenceFactor", "iridescenceThicknessTexture", &M::iridescenceThicknessTexture},
      {"volume", "thicknessFactor", "thicknessTexture", &M::thicknessTexture}};
  for (const LayerTexture& texture : textures) {
    for (const int factor : {0, 1}) {
      GltfBuilder builder = GltfBuilder::emissiveTriangle();
      Json& layer = builder.json["materials"][0]["extensions"][kLayers + texture.extension];
      layer[texture.key]["index"] = builder.addTexture(makePng(1, 1, Bytes(4, 128)));
      layer[texture.factor] = factor;
      if (texture.factor == "sheenColorFactor") layer[texture.factor] = {0, factor, 0};
      const Scene scene = load(builder);
      const uint used = scene.materials[0].*texture.field;
      ASSERT_EQ(used != kNone, factor == 1) << texture.key;
      ASSERT_EQ(used != kNone && scene.textures[used].isSrgb != 0, used != kNone && texture.isSrgb) << texture.key;
    }
  }
}

/// An anisotropic surface needs tangents, with a texture or without.
TEST(MaterialLayers, OfAnisotropyGetTangents) {
  for (const bool hasTexture : {true, false}) {
    GltfBuilder builder = GltfBuilder::emissiveTriangle();
    builder.primitive()["attributes"]["TEXCOORD_0"] =
        builder.addAccessor(std::vector<glm::vec2>{{0, 0}, {0, 1}, {1, 0}}, kFloat, "VEC2");
    Json& layer = builder.json["materials"][0]["extensions"]["KHR_materials_anisotropy"];
    layer["anisotropyStrength"] = 0.5;
    if (hasTexture) layer["anisotropyTexture"]["index"] = builder.addTexture(makePng(1, 1, Bytes(4, 128)));
    const Scene scene = load(builder);
    ASSERT_NE(scene.vertices[0].tangent, kNone);
    EXPECT_EQ(scene.vertices[0].tangent, packTangent({0, 1, 0}, false));  // where u grows
  }
}

TEST(MaterialLayers, MayBeRequired) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  for (const char* name : {"diffuse_transmission", "sheen", "anisotropy", "iridescence", "dispersion"})
    builder.json["extensionsRequired"].push_back(std::string(kLayers) + name);
  EXPECT_EQ(errorOf(builder), "");
}

TEST(MaterialLayers, RefuseFactorsOutOfRange) {
  const auto error = [](const std::string& extension, const std::string& key, const Json& value) {
    GltfBuilder builder = GltfBuilder::emissiveTriangle();
    builder.json["materials"][0]["extensions"][kLayers + extension][key] = value;
    return errorOf(builder, kStrict);
  };
  const auto names = [](const std::string& text, const std::string& key) { return text.find(key) != text.npos; };
  EXPECT_TRUE(names(error("diffuse_transmission", "diffuseTransmissionFactor", -1), "/diffuseTransmissionFactor"));
  EXPECT_TRUE(names(error("sheen", "sheenColorFactor", {2, 0, 0}), "/sheenColorFactor"));
  EXPECT_TRUE(names(error("anisotropy", "anisotropyStrength", "much"), "/anisotropyStrength"));
  EXPECT_TRUE(names(error("iridescence", "iridescenceIor", 0.5), "/iridescenceIor"));
  EXPECT_TRUE(names(error("dispersion", "dispersion", -1), "/dispersion"));
}

}  // namespace
}  // namespace importon::test::layers_test
