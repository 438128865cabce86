#include <gtest/gtest.h>

#include "loader/image_builder.h"
#include "loader/load.h"
#include "scene/meshes/tangents.h"
#include "scene/packing.h"

namespace importon::test {
namespace {

/// A triangle that faces +z, u to the right and v down, as images lie.
MeshPart facingPart() {
  MeshPart part;
  part.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  part.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  part.uv0 = {{0, 1}, {1, 1}, {0, 0}};
  part.uv1 = {{0, 1}, {0, 0}, {1, 1}};
  part.triangles = {{0, 1, 2}};
  return part;
}

Texture plainTexture() {
  Texture texture{};
  texture.uvRow0 = vec3(1, 0, 0);
  texture.uvRow1 = vec3(0, 1, 0);
  return texture;
}

TEST(Tangents, RunAlongUAndTheBitangentAgainstV) {
  MeshPart part = facingPart();
  computeTangents(part, plainTexture());
  for (const vec4& tangent : part.tangents) EXPECT_EQ(tangent, vec4(1, 0, 0, 1));
}

TEST(Tangents, MirroredUvsTurnTheBitangent) {
  MeshPart part = facingPart();
  for (vec2& uv : part.uv0) uv.x = -uv.x;
  computeTangents(part, plainTexture());
  for (const vec4& tangent : part.tangents) EXPECT_EQ(tangent, vec4(-1, 0, 0, -1));
}

TEST(Tangents, FollowTheUvSetOfTheTexture) {
  MeshPart part = facingPart();
  Texture texture = plainTexture();
  texture.uvSet = 1;
  computeTangents(part, texture);
  for (const vec4& tangent : part.tangents) EXPECT_EQ(tangent, vec4(0, 1, 0, -1));
}

TEST(Tangents, FollowTheTransformOfTheTexture) {
  MeshPart part = facingPart();
  Texture texture = plainTexture();
  texture.uvRow0 = vec3(0, -1, 0);  // a quarter turn: u' = -v, v' = u
  texture.uvRow1 = vec3(1, 0, 0);
  computeTangents(part, texture);
  for (const vec4& tangent : part.tangents) EXPECT_EQ(tangent, vec4(0, 1, 0, 1));
}

TEST(Tangents, AreNormalToTheNormal) {
  MeshPart part = facingPart();
  part.normals.assign(3, glm::normalize(vec3(1, 0, 1)));
  computeTangents(part, plainTexture());
  for (const vec4& tangent : part.tangents) {
    EXPECT_NEAR(glm::dot(vec3(tangent), part.normals[0]), 0, 1e-6);
    EXPECT_NEAR(glm::length(vec3(tangent)), 1, 1e-6);
  }
}

TEST(Tangents, DegenerateUvsGiveNone) {
  MeshPart part = facingPart();
  part.uv0.assign(3, vec2(0.5f));
  computeTangents(part, plainTexture());
  for (const vec4& tangent : part.tangents) EXPECT_EQ(vec3(tangent), vec3(0));
}

TEST(Tangents, AreMadeForNormalMapsOnly) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.primitive()["attributes"]["TEXCOORD_0"] =
      builder.addAccessor(std::vector<glm::vec2>{{0, 1}, {1, 1}, {0, 0}}, kFloat, "VEC2");
  EXPECT_EQ(load(builder).vertices[0].tangent, kNone);
  const int texture = builder.addTexture(makePng(1, 1, {128, 128, 255, 255}));
  builder.json["materials"][0]["normalTexture"] = {{"index", texture}, {"scale", 0.5}};
  const Scene scene = load(builder);
  EXPECT_EQ(unpackTangent(scene.vertices[0].tangent), vec4(1, 0, 0, 1));
  EXPECT_EQ(scene.materials[0].normalScale, 0.5f);
}

}  // namespace
}  // namespace importon::test
