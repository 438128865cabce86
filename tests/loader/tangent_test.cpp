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

/// Two triangles side by side that face +z; u grows to the middle from both sides, where they share two vertices.
MeshPart mirroredPart() {
  MeshPart part;
  part.positions = {{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  part.normals.assign(4, vec3(0, 0, 1));
  part.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 1}};
  part.colors = {vec4(0.1f), vec4(0.2f), vec4(0.3f), vec4(0.4f)};
  part.triangles = {{0, 1, 2}, {1, 3, 2}};
  return part;
}

/// Of a corner's vertex.
vec4 tangentAt(const MeshPart& part, int triangle, int corner) {
  return part.tangents[part.triangles[static_cast<std::size_t>(triangle)][corner]];
}

TEST(Tangents, VerticesAreSplitWhereUvsTurn) {
  MeshPart part = mirroredPart();
  const MeshPart before = part;
  computeTangents(part, plainTexture());
  EXPECT_EQ(part.positions.size(), 6u);
  for (int corner = 0; corner < 3; ++corner) {
    EXPECT_EQ(tangentAt(part, 0, corner), vec4(1, 0, 0, 1));
    EXPECT_EQ(tangentAt(part, 1, corner), vec4(-1, 0, 0, -1));
    for (std::size_t t = 0; t < 2; ++t) {
      const uint now = part.triangles[t][corner], then = before.triangles[t][corner];
      EXPECT_EQ(part.positions[now], before.positions[then]);
      EXPECT_EQ(part.uv0[now], before.uv0[then]);
      EXPECT_EQ(part.colors[now], before.colors[then]);
    }
  }
}

// A file may split what is one, at a seam of its own: equal vertices have equal tangents all the same.
TEST(Tangents, AreTheSameForSplitAndSharedVertices) {
  for (const bool isMirrored : {false, true}) {
    MeshPart shared = mirroredPart();
    shared.positions[3].z = 0.5f;  // so that the triangles have tangents of their own
    if (!isMirrored) shared.uv0[3] = {2, 1};
    MeshPart split = shared;
    split.positions.push_back(split.positions[1]);
    split.positions.push_back(split.positions[2]);
    split.normals.assign(6, vec3(0, 0, 1));
    split.uv0.push_back(split.uv0[1]);
    split.uv0.push_back(split.uv0[2]);
    split.colors.assign(6, vec4(1));
    split.triangles[1] = {4, 3, 5};
    computeTangents(shared, plainTexture());
    computeTangents(split, plainTexture());
    for (int t = 0; t < 2; ++t)
      for (int corner = 0; corner < 3; ++corner) EXPECT_EQ(tangentAt(shared, t, corner), tangentAt(split, t, corner));
  }
}

// Three triangles around the origin, of 90, 45 and 45 degrees there, each with a tangent of its own.
TEST(Tangents, AreWeighedByTheAngleAtTheVertexWhateverTheArea) {
  MeshPart part;
  part.positions = {{0, 0, 0}, {1, 0, 0}, {0, 7, 0}, {-5, 5, 0}, {-1, 0, 0}};
  part.normals.assign(5, vec3(0, 0, 1));
  part.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  for (const vec3& p : part.positions) part.uv0.push_back({p.x + 0.1f * p.y * p.y, -p.y});
  glm::dvec3 expected(0.0);
  const double angles[3] = {M_PI / 2, M_PI / 4, M_PI / 4};
  for (std::size_t t = 0; t < 3; ++t) {
    const glm::dvec3 e1 = part.positions[part.triangles[t].y], e2 = part.positions[part.triangles[t].z];
    const glm::dvec2 d1 = part.uv0[part.triangles[t].y], d2 = part.uv0[part.triangles[t].z];
    expected += angles[t] * glm::normalize(-(e1 * d2.y - e2 * d1.y));
  }
  computeTangents(part, plainTexture());
  EXPECT_NEAR(glm::length(glm::dvec3(part.tangents[0]) - glm::normalize(expected)), 0, 1e-6);
}

TEST(Tangents, WithoutNormalsLieInEachTriangle) {
  MeshPart part = mirroredPart();
  part.uv0[3] = {2, 1};
  part.positions[3] = {0, 0, 1};  // a fold of 90 degrees about the shared edge
  part.normals.clear();
  computeTangents(part, plainTexture());
  for (int corner = 0; corner < 3; ++corner) {
    EXPECT_NEAR(tangentAt(part, 0, corner).z, 0, 1e-6);
    EXPECT_NEAR(tangentAt(part, 1, corner).x, 0, 1e-6);
  }
}

TEST(Tangents, OfTrianglesWithoutUsableUvsAreThoseOfTheirNeighbours) {
  MeshPart part = mirroredPart();
  part.uv0[3] = part.uv0[1];
  computeTangents(part, plainTexture());
  EXPECT_EQ(part.positions.size(), 4u);
  for (const int corner : {0, 2}) EXPECT_EQ(tangentAt(part, 1, corner), vec4(1, 0, 0, 1));
  EXPECT_EQ(vec3(tangentAt(part, 1, 1)), vec3(0));
}

TEST(Tangents, WithoutNormalsAreThoseOfFlatShading) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  nlohmann::json& attributes = builder.primitive()["attributes"];
  attributes.erase("NORMAL");
  attributes["TEXCOORD_0"] = builder.addAccessor(std::vector<glm::vec2>{{0, 1}, {1, 1}, {0, 0}}, kFloat, "VEC2");
  attributes["TANGENT"] = builder.addAccessor(std::vector<glm::vec4>(3, {0, 1, 0, -1}), kFloat, "VEC4");
  const int texture = builder.addTexture(makePng(1, 1, {128, 128, 255, 255}));
  builder.json["materials"][0]["normalTexture"] = {{"index", texture}};
  EXPECT_EQ(unpackTangent(load(builder).vertices[0].tangent), vec4(1, 0, 0, 1));
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
