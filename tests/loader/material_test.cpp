#include <gtest/gtest.h>

#include "loader/image_builder.h"
#include "loader/load.h"

namespace importon::test {
namespace {

TEST(Material, DefaultsAreThoseOfGltf) {
  const Material material = materialWith([](Json&) {});
  EXPECT_EQ(material.baseColor, vec4(1));
  EXPECT_EQ(material.metallic, 1);
  EXPECT_EQ(material.roughness, 1);
  EXPECT_EQ(material.specular, 1);
  EXPECT_EQ(material.specularColor, vec3(1));
  EXPECT_EQ(material.ior, 1.5f);
  EXPECT_EQ(material.transmission, 0);
  EXPECT_EQ(material.absorption, vec3(0));
  EXPECT_EQ(material.clearcoat, 0);
  EXPECT_EQ(material.clearcoatRoughness, 0);
  EXPECT_EQ(material.alphaCutoff, 0.5f);
  EXPECT_EQ(material.normalScale, 1);
  EXPECT_EQ(material.flags, kMaterialEmissive);
  for (const uint texture :
       {material.baseColorTexture, material.metallicRoughnessTexture, material.normalTexture, material.emissiveTexture,
        material.transmissionTexture, material.specularTexture, material.specularColorTexture,
        material.clearcoatTexture, material.clearcoatRoughnessTexture}) {
    EXPECT_EQ(texture, kNone);
  }
}

TEST(Material, ReadsTheNormalMapOfACoat) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const int texture = builder.addTexture(makePng(1, 1, Bytes(4, 128)));
  builder.primitive()["attributes"]["TEXCOORD_0"] =
      builder.addAccessor(std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}, kFloat, "VEC2");
  builder.json["materials"][0]["extensions"]["KHR_materials_clearcoat"] = {
      {"clearcoatFactor", 1}, {"clearcoatNormalTexture", {{"index", texture}, {"scale", 0.5}}}};
  const Scene scene = load(builder);
  const Material& material = scene.materials[0];
  EXPECT_NE(material.clearcoatNormalTexture, kNone);
  EXPECT_EQ(material.clearcoatNormalScale, 0.5f);
  EXPECT_EQ(material.normalTexture, kNone);
  EXPECT_NE(scene.vertices[0].tangent, kNone);  // computed, as for other normal maps
}

TEST(Material, ReadsMetallicRoughness) {
  const Material material = materialWith([](Json& json) {
    json["pbrMetallicRoughness"] = {
        {"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.25}, {"roughnessFactor", 0.75}};
  });
  EXPECT_EQ(material.baseColor, vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(material.metallic, 0.25f);
  EXPECT_EQ(material.roughness, 0.75f);
}

TEST(Material, EmissionIsFactorTimesStrength) {
  EXPECT_EQ(materialWith([](Json&) {}).emission, vec3(1, 2, 3));
  EXPECT_EQ(materialWith([](Json& json) { json.erase("extensions"); }).emission, vec3(0.25f, 0.5f, 0.75f));
  const Material dim =
      materialWith([](Json& json) { json["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 0.5; });
  EXPECT_EQ(dim.emission, vec3(0.125f, 0.25f, 0.375f));
}

TEST(Material, AStrengthBeyond32BitIntegersIsKept) {
  const Material material = materialWith(
      [](Json& json) { json["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 8000000000; });
  EXPECT_EQ(material.emission, vec3(2e9f, 4e9f, 6e9f));
}

TEST(Material, ReadsFlags) {
  EXPECT_EQ(materialWith([](Json& json) { json["doubleSided"] = true; }).flags,
            kMaterialEmissive | kMaterialDoubleSided);
  EXPECT_EQ(materialWith([](Json& json) { json["alphaMode"] = "BLEND"; }).flags,
            kMaterialEmissive | kMaterialAlphaBlend);
  EXPECT_EQ(materialWith([](Json& json) { json["alphaMode"] = "OPAQUE"; }).flags, kMaterialEmissive);
  EXPECT_EQ(materialWith([](Json& json) { json["extensions"]["KHR_materials_unlit"] = Json::object(); }).flags,
            kMaterialEmissive | kMaterialUnlit);
  const Material mask = materialWith([](Json& json) {
    json["alphaMode"] = "MASK";
    json["alphaCutoff"] = 0.25;
  });
  EXPECT_EQ(mask.flags, kMaterialEmissive | kMaterialAlphaMask);
  EXPECT_EQ(mask.alphaCutoff, 0.25f);
}

TEST(Material, ReadsTransmissionAndIor) {
  const Material material = materialWith([](Json& json) {
    json["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = 0.9;
    json["extensions"]["KHR_materials_ior"]["ior"] = 1.33;
  });
  EXPECT_EQ(material.transmission, 0.9f);
  EXPECT_EQ(material.ior, 1.33f);
  EXPECT_EQ(material.flags & kMaterialSolid, 0u);
}

TEST(Material, AnIorOfZeroReflectsAll) {
  const float ior = materialWith([](Json& json) { json["extensions"]["KHR_materials_ior"]["ior"] = 0; }).ior;
  EXPECT_GT((ior - 1) * (ior - 1) / ((ior + 1) * (ior + 1)), 0.999f);
}

TEST(Material, AbsorptionFollowsFromAttenuation) {
  const auto volume = [](const Json& extension) {
    return materialWith([&](Json& json) { json["extensions"]["KHR_materials_volume"] = extension; });
  };
  const Material solid =
      volume({{"thicknessFactor", 1}, {"attenuationColor", {0.5, 1, 0.25}}, {"attenuationDistance", 2}});
  EXPECT_EQ(solid.flags & kMaterialSolid, kMaterialSolid);
  EXPECT_NEAR(solid.absorption.x, std::log(2.0) / 2, 1e-7);
  EXPECT_EQ(solid.absorption.y, 0);
  EXPECT_NEAR(solid.absorption.z, std::log(4.0) / 2, 1e-7);
  EXPECT_EQ(volume({{"thicknessFactor", 1}, {"attenuationColor", {0.5, 1, 0.25}}}).absorption, vec3(0));
  const Material thin = volume({{"attenuationColor", {0.5, 1, 0.25}}, {"attenuationDistance", 2}});
  EXPECT_EQ(thin.flags & kMaterialSolid, 0u);
  EXPECT_EQ(thin.absorption, vec3(0));
  const Material black =
      volume({{"thicknessFactor", 1}, {"attenuationColor", {0, 1, 1}}, {"attenuationDistance", 0.5}});
  EXPECT_TRUE(std::isfinite(black.absorption.x));
  EXPECT_GT(black.absorption.x, 100);
}

TEST(Material, ReadsSpecularAndClearcoat) {
  const Material material = materialWith([](Json& json) {
    json["extensions"]["KHR_materials_specular"] = {{"specularFactor", 0}, {"specularColorFactor", {0.1, 0.2, 3}}};
    json["extensions"]["KHR_materials_clearcoat"] = {{"clearcoatFactor", 0.5}, {"clearcoatRoughnessFactor", 0.1}};
  });
  EXPECT_EQ(material.specular, 0);
  EXPECT_EQ(material.specularColor, vec3(0.1f, 0.2f, 3));
  EXPECT_EQ(material.clearcoat, 0.5f);
  EXPECT_EQ(material.clearcoatRoughness, 0.1f);
}

TEST(Material, APrimitiveWithoutOneGetsTheDefaultWhichStandsLast) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.addMesh({{"attributes", {{"POSITION", 0}}}});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.triangles[1].material, 1u);
  EXPECT_EQ(scene.materials[1].metallic, 1);
  EXPECT_EQ(scene.materials[1].flags, 0u);
  EXPECT_EQ(scene.materialNames, (std::vector<std::string>{"glow", "default"}));
}

TEST(Material, UnusedOnesAreLeftOut) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["materials"].insert(builder.json["materials"].begin(), Json::object({{"name", "unused"}}));
  builder.primitive()["material"] = 1;
  const Scene scene = load(builder);
  EXPECT_EQ(scene.materialNames, std::vector<std::string>{"glow"});
  EXPECT_EQ(scene.triangles[0].material, 0u);
}

/// Every texture slot, its place in the JSON, and whether it is a colour.
struct Slot {
  const char* pointer;
  uint Material::*index;
  bool isSrgb;
};

TEST(Material, EachTextureFindsItsSlotAndItsMeaning) {
  const Slot slots[] = {
      {"/pbrMetallicRoughness/baseColorTexture", &Material::baseColorTexture, true},
      {"/pbrMetallicRoughness/metallicRoughnessTexture", &Material::metallicRoughnessTexture, false},
      {"/normalTexture", &Material::normalTexture, false},
      {"/emissiveTexture", &Material::emissiveTexture, true},
      {"/extensions/KHR_materials_transmission/transmissionTexture", &Material::transmissionTexture, false},
      {"/extensions/KHR_materials_specular/specularTexture", &Material::specularTexture, false},
      {"/extensions/KHR_materials_specular/specularColorTexture", &Material::specularColorTexture, true},
      {"/extensions/KHR_materials_clearcoat/clearcoatTexture", &Material::clearcoatTexture, false},
      {"/extensions/KHR_materials_clearcoat/clearcoatRoughnessTexture", &Material::clearcoatRoughnessTexture, false}};
  for (const Slot& slot : slots) {
    GltfBuilder builder = GltfBuilder::emissiveTriangle();
    builder.primitive()["attributes"]["TEXCOORD_0"] =
        builder.addAccessor(std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}, kFloat, "VEC2");
    builder.json["materials"][0]["extensions"]["KHR_materials_clearcoat"]["clearcoatFactor"] = 1;
    const int texture = builder.addTexture(makePng(1, 1, {255, 255, 255, 255}));
    builder.json["materials"][0][Json::json_pointer(slot.pointer)] = {{"index", texture}};
    const Scene scene = load(builder);
    ASSERT_EQ(scene.textures.size(), 1u) << slot.pointer;
    EXPECT_EQ(scene.materials[0].*slot.index, 0u) << slot.pointer;
    EXPECT_EQ(scene.textures[0].isSrgb, slot.isSrgb ? 1u : 0u) << slot.pointer;
  }
}

}  // namespace
}  // namespace importon::test
