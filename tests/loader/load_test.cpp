// Large files: much of everything, in time that grows with their size alone.
#include "loader/load.h"

#include <gtest/gtest.h>

#include <chrono>

#include "loader/image_builder.h"

namespace importon::test {
namespace {

/// Far above what it takes, far below what anything quadratic would.
constexpr double kMostSeconds = 60;

double secondsOf(const GltfBuilder& builder, Scene& scene) {
  const auto start = std::chrono::steady_clock::now();
  scene = load(builder);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST(Load, BearsAThousandTextures) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.primitive()["attributes"]["TEXCOORD_0"] =
      builder.addAccessor(std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}, kFloat, "VEC2");
  const Json primitive = builder.primitive();
  for (int i = 0; i < 1000; ++i) {
    const int texture = builder.addTexture(
        makePng(1, 1, {static_cast<unsigned char>(i % 256), static_cast<unsigned char>(i / 256), 0, 255}));
    Json own = primitive;
    own["material"] =
        builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}}}});
    builder.addMesh(own);
  }
  Scene scene;
  EXPECT_LT(secondsOf(builder, scene), kMostSeconds);
  EXPECT_EQ(scene.textures.size(), 1000u);
  EXPECT_EQ(scene.triangles.size(), 1001u);
  const Texture& last = scene.textures[scene.materials[scene.triangles.back().material].baseColorTexture];
  EXPECT_EQ(scene.texels[last.firstTexel] & 0xFFFFu, 999u);  // red and green count the image
}

TEST(Load, BearsTenThousandNodesSideBySideWithLights) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({{{"type", "point"}}});
  for (int i = 0; i < 10000; ++i)
    builder.addRoot({{"mesh", 0},
                     {"translation", {i % 100, i / 100, 0}},
                     {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  Scene scene;
  EXPECT_LT(secondsOf(builder, scene), kMostSeconds);
  EXPECT_EQ(scene.triangles.size(), 10001u);
  EXPECT_EQ(scene.lights.size(), 20001u);
}

}  // namespace
}  // namespace importon::test
