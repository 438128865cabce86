#include <gtest/gtest.h>

#include "loader/image_builder.h"
#include "loader/load.h"
#include "scene/images/texture_sampling.h"

namespace importon::test {
namespace {

const Bytes kTwoTexels = makePng(2, 1, {255, 0, 0, 255, 0, 0, 255, 255});

/// The emissive triangle with texture coordinates and a base colour texture that `info` describes further.
GltfBuilder textured(const Json& info = Json::object(), const Json& sampler = {}) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const int uvs = builder.addAccessor(std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}, kFloat, "VEC2");
  builder.primitive()["attributes"]["TEXCOORD_0"] = uvs;
  builder.primitive()["attributes"]["TEXCOORD_1"] = uvs;
  Json texture = info;
  texture["index"] = builder.addTexture(kTwoTexels, sampler);
  builder.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = texture;
  return builder;
}

TEST(Texture, HoldsItsTexels) {
  const Scene scene = load(textured());
  ASSERT_EQ(scene.textures.size(), 1u);
  const Texture& texture = scene.textures[0];
  EXPECT_EQ(texture.width, 2u);
  EXPECT_EQ(texture.height, 1u);
  EXPECT_EQ(scene.texels, (std::vector<uint>{0xFF0000FFu, 0xFFFF0000u}));
}

TEST(Texture, RepeatsAndInterpolatesWithoutASampler) {
  const Texture texture = load(textured()).textures.at(0);
  EXPECT_EQ(texture.wrapS, kWrapRepeat);
  EXPECT_EQ(texture.wrapT, kWrapRepeat);
  EXPECT_EQ(texture.isNearest, 0u);
  EXPECT_EQ(texture.uvSet, 0u);
  EXPECT_EQ(texture.uvRow0, vec3(1, 0, 0));
  EXPECT_EQ(texture.uvRow1, vec3(0, 1, 0));
}

TEST(Texture, FollowsItsSampler) {
  const Texture texture =
      load(textured(Json::object(), {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}})).textures.at(0);
  EXPECT_EQ(texture.wrapS, kWrapClamp);
  EXPECT_EQ(texture.wrapT, kWrapMirror);
  EXPECT_EQ(texture.isNearest, 1u);
  EXPECT_EQ(load(textured(Json::object(), {{"minFilter", 9728}})).textures[0].isNearest, 1u);
  EXPECT_EQ(load(textured(Json::object(), {{"magFilter", 9729}, {"minFilter", 9728}})).textures[0].isNearest, 0u);
}

TEST(Texture, AnUnknownWrappingModeIsAFault) {
  EXPECT_NE(errorOf(textured(Json::object(), {{"wrapS", 10496}}), kStrict)
                .find("wrapping mode 10496 is unknown (test.glb#/samplers/0/wrapS)"),
            std::string::npos);
}

TEST(Texture, ReadsTheSecondUvSet) { EXPECT_EQ(load(textured({{"texCoord", 1}})).textures.at(0).uvSet, 1u); }

TEST(Texture, WarnsOfUvSetsBeyondTheSecond) {
  const std::vector<Warning> warnings = warningsOf(textured({{"texCoord", 2}}));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message.find("TEXCOORD_2"), std::string::npos);
}

TEST(Texture, WarnsOfAMeshWithoutTextureCoordinates) {
  GltfBuilder builder = textured();
  builder.primitive()["attributes"].erase("TEXCOORD_0");
  const std::vector<Warning> warnings = warningsOf(builder);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].kind, "texture without coordinates");
}

Texture transformed(const Json& transform) {
  return load(textured({{"extensions", {{"KHR_texture_transform", transform}}}})).textures.at(0);
}

TEST(TextureTransform, ScalesThenTurnsThenMoves) {
  const Texture moved = transformed({{"offset", {0.25, 0.5}}, {"scale", {2, 3}}});
  EXPECT_EQ(transformUv(moved, {1, 1}), vec2(2.25f, 3.5f));
  // The lower left quarter, turned clockwise: the example of KHR_texture_transform.
  const Texture turned = transformed({{"offset", {0, 1}}, {"rotation", 1.57079632679489661}, {"scale", {0.5, 0.5}}});
  const auto near = [&](const vec2& uv, const vec2& expected) {
    EXPECT_LT(glm::length(transformUv(turned, uv) - expected), 1e-6f);
  };
  near({0, 0}, {0, 1});
  near({1, 0}, {0, 0.5f});
  near({0, 1}, {0.5f, 1});
}

TEST(TextureTransform, OverridesTheUvSet) { EXPECT_EQ(transformed({{"texCoord", 1}}).uvSet, 1u); }

TEST(Texture, AnImageIsKeptOnceForAllItsUses) {
  GltfBuilder builder = textured();
  Json& material = builder.json["materials"][0];
  material["emissiveTexture"] = {{"index", 0}};  // the same use
  material["normalTexture"] = {{"index", 0}};    // linear
  material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 0}, {"texCoord", 1}};
  const Scene scene = load(builder);
  EXPECT_EQ(scene.texels.size(), 2u);
  EXPECT_EQ(scene.textures.size(), 3u);
  EXPECT_EQ(scene.materials[0].emissiveTexture, scene.materials[0].baseColorTexture);
  for (const Texture& texture : scene.textures) EXPECT_EQ(texture.firstTexel, 0u);
}

TEST(Texture, SixteenBitsAreKeptForQuantitiesOnly) {
  const Bytes png = makePng({.bitDepth = 16}, {0x12, 0x34, 0x56, 0x78, 0x9A, 0xBC, 0xDE, 0xF0});
  GltfBuilder builder = textured();
  const int deep = builder.addTexture(png), cut = builder.addTexture(png);
  Json& material = builder.json["materials"][0];
  material["normalTexture"]["index"] = deep;
  material["pbrMetallicRoughness"]["metallicRoughnessTexture"]["index"] = deep;
  material["emissiveTexture"]["index"] = cut;
  const Scene scene = load(builder);
  const Texture& normal = scene.textures[scene.materials[0].normalTexture];
  EXPECT_EQ(normal.isDeep, 1u);
  EXPECT_EQ(scene.texels[normal.firstTexel], 0x56781234u);
  EXPECT_EQ(scene.texels[normal.firstTexel + 1], 0xDEF09ABCu);
  EXPECT_EQ(scene.materials[0].metallicRoughnessTexture, scene.materials[0].normalTexture);
  const Texture& emission = scene.textures[scene.materials[0].emissiveTexture];
  EXPECT_EQ(emission.isDeep, 0u);
  EXPECT_EQ(scene.texels[emission.firstTexel], 0xDE9A5612u);
  EXPECT_EQ(scene.textures[scene.materials[0].baseColorTexture].isDeep, 0u);
}

TEST(Texture, UnusedImagesAreNotDecoded) {
  GltfBuilder builder = textured();
  builder.addTexture(toBytes("no image at all"));
  EXPECT_EQ(load(builder).textures.size(), 1u);
}

TEST(Texture, WithoutAReadableImageIsPassedOverWithAWarning) {
  GltfBuilder builder = textured();
  builder.json["textures"][0].erase("source");
  Log log(Log::Verbosity::quiet);
  EXPECT_EQ(load(builder.glb(), log).materials[0].baseColorTexture, kNone);
  ASSERT_EQ(log.warnings().size(), 1u);
  EXPECT_EQ(log.warnings()[0].kind, "texture without image");
}

/// Red at the left, blue at the right; linear, not interpolated.
struct TwoTexels {
  std::vector<uint> texels{0xFF0000FFu, 0xFFFF0000u};
  Texture texture = load(textured()).textures.at(0);
};

TEST(TextureSampling, WrapsAsTheSamplerSays) {
  TwoTexels image;
  const auto isRed = [&](uint mode, float u) {
    image.texture.wrapS = mode;
    return nearestTexel(image.texture, image.texels, {u, 0.5f}).x > 0.5f;
  };
  EXPECT_TRUE(isRed(kWrapRepeat, 0.25f));
  EXPECT_FALSE(isRed(kWrapRepeat, 0.75f));
  EXPECT_TRUE(isRed(kWrapRepeat, 1.25f));
  EXPECT_FALSE(isRed(kWrapRepeat, -0.25f));
  EXPECT_FALSE(isRed(kWrapClamp, 1.25f));
  EXPECT_TRUE(isRed(kWrapClamp, -0.25f));
  EXPECT_FALSE(isRed(kWrapMirror, 1.25f));
  EXPECT_TRUE(isRed(kWrapMirror, -0.25f));
  EXPECT_TRUE(isRed(kWrapMirror, 2.25f));
}

TEST(TextureSampling, HugeCoordinatesStayInside) {
  TwoTexels image;
  for (const float u : {1e30f, -1e30f, 3e38f}) {
    for (const uint mode : {kWrapRepeat, kWrapClamp, kWrapMirror}) {
      image.texture.wrapS = mode;
      const vec4 color = nearestTexel(image.texture, image.texels, {u, u});
      EXPECT_NEAR(color.x + color.z, 1.0f, 1e-6f);
    }
  }
}

TEST(TextureSampling, TheMeanOverATriangleIsThatOfItsFootprint) {
  TwoTexels image;
  const auto mean = [&](const vec2(&uv)[3]) {
    const TriangleTexture onTriangle(image.texture, image.texels, uv);
    return vec3(
        meanOverTriangle(onTriangle.samplesPerSide(), [&](float u, float v) { return vec3(onTriangle.at(u, v)); }));
  };
  EXPECT_LT(glm::length(mean({{0, 0}, {0.5f, 0}, {0, 1}}) - vec3(1, 0, 0)), 1e-6f);
  EXPECT_LT(glm::length(mean({{0, 0}, {64, 0}, {0, 1}}) - vec3(0.5f, 0, 0.5f)), 0.02f);
  EXPECT_LT(glm::length(mean({{0.75f, 0}, {0.75f, 0}, {0.75f, 0}}) - vec3(0, 0, 1)), 1e-6f);
}

TEST(TextureSampling, DeepTexelsHoldTwoWords) {
  Texture texture{};
  texture.isDeep = 1;
  texture.firstTexel = 1;
  texture.width = 2;
  texture.height = 1;
  const std::vector<uint> texels = {0, 0, 0, 0x8000FFFFu, 0xFFFF4000u};
  const vec4 color = texelAt(texture, texels, 1);
  EXPECT_EQ(color.x, 1.0f);
  EXPECT_NEAR(color.y, 32768.0 / 65535, 1e-6);
  EXPECT_NEAR(color.z, 16384.0 / 65535, 1e-6);
  texture.isSrgb = 1;
  EXPECT_NEAR(texelAt(texture, texels, 1).y, 0.214053, 1e-4);
}

TEST(TextureSampling, ColoursAreDecodedFromSrgb) {
  TwoTexels image;
  image.texels[0] = 0xFF0000BCu;  // 188/255
  image.texture.isSrgb = 1;
  EXPECT_NEAR(nearestTexel(image.texture, image.texels, {0.25f, 0}).x, 0.502886, 1e-5);
  image.texture.isSrgb = 0;
  EXPECT_NEAR(nearestTexel(image.texture, image.texels, {0.25f, 0}).x, 188.0 / 255, 1e-6);
}

}  // namespace
}  // namespace importon::test
