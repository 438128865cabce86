#include "support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <tuple>

#include "scene/lights.h"
#include "scene/packing.h"

namespace importon::test {
namespace {

constexpr double kPi = glm::pi<double>();

struct Measures {
  double area = 0;
  double volume = 0;  // signed; positive if fronts face outside
  std::size_t openEdges = 0;
};

/// Edges are compared by position, so that seams count as closed.
Measures measure(const Scene& scene) {
  using Point = std::tuple<float, float, float>;
  Measures result;
  std::map<std::pair<Point, Point>, int> edges;
  const auto pointOf = [&](uint v) {
    const vec3& p = scene.positions[v];
    return Point(p.x + 0.0f, p.y + 0.0f, p.z + 0.0f);
  };
  for (const Triangle& t : scene.triangles) {
    const glm::dvec3 a(scene.positions[t.v0]), b(scene.positions[t.v1]), c(scene.positions[t.v2]);
    result.area += 0.5 * glm::length(glm::cross(b - a, c - a));
    result.volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    const uint corners[3] = {t.v0, t.v1, t.v2};
    for (int k = 0; k < 3; ++k) {
      const Point p = pointOf(corners[k]), q = pointOf(corners[(k + 1) % 3]);
      ++edges[{p, q}];
      --edges[{q, p}];
    }
  }
  for (const auto& [edge, balance] : edges) result.openEdges += balance != 0;
  return result;
}

template <class Shape>
Measures measureShape(Shape&& addShape) {
  SceneBuilder builder;
  addShape(builder, builder.material(diffuse(vec3(0.5f))));
  return measure(builder.finish());
}

TEST(SceneBuilder, BoxIsClosedWhicheverWayItFaces) {
  for (const Facing facing : {Facing::outside, Facing::inside}) {
    const double sign = facing == Facing::outside ? 1 : -1;
    const Measures box = measureShape([&](SceneBuilder& builder, uint material) {
      builder.box(material, {-1, 0, 2}, {1, 3, 6}, facing, 3);
    });
    EXPECT_EQ(box.openEdges, 0u);
    EXPECT_NEAR(box.area, 2 * (2 * 3 + 3 * 4 + 2 * 4), 1e-6);
    EXPECT_NEAR(box.volume, sign * 24.0, 1e-5);
  }
}

TEST(SceneBuilder, SpheresAreClosedWhicheverWayTheyFace) {
  for (const Facing facing : {Facing::outside, Facing::inside}) {
    const double sign = facing == Facing::outside ? 1 : -1;
    const Measures uv = measureShape([&](SceneBuilder& builder, uint material) {
      builder.uvSphere(material, {1, 2, 3}, 2.0, 64, 128, facing, Shading::flat);
    });
    const Measures ico = measureShape([&](SceneBuilder& builder, uint material) {
      builder.icosphere(material, {1, 2, 3}, 2.0, 4, facing, Shading::flat);
    });
    for (const Measures& sphere : {uv, ico}) {
      EXPECT_EQ(sphere.openEdges, 0u);
      EXPECT_NEAR(sphere.area, 16.0 * kPi, 0.004 * 16.0 * kPi);
      EXPECT_NEAR(sphere.volume, sign * 32.0 / 3.0 * kPi, 0.006 * 32.0 / 3.0 * kPi);
    }
  }
}

TEST(SceneBuilder, IcosphereHasTwentyTimesFourToTheNTriangles) {
  SceneBuilder builder;
  builder.icosphere(builder.material(diffuse(vec3(0.5f))), {0, 0, 0}, 1.0, 3, Facing::outside, Shading::flat);
  const Scene scene = builder.finish();
  EXPECT_EQ(scene.triangles.size(), 1280u);
  EXPECT_EQ(scene.positions.size(), 642u);  // 10·4^n + 2
}

TEST(SceneBuilder, SmoothNormalsPointToTheFront) {
  for (const auto& [facing, sign] : {std::pair(Facing::outside, 1.0f), std::pair(Facing::inside, -1.0f)}) {
    SceneBuilder builder;
    const uint material = builder.material(diffuse(vec3(0.5f)));
    builder.uvSphere(material, {0, 0, 0}, 1.0, 8, 16, facing, Shading::smooth);
    builder.icosphere(material, {0, 0, 0}, 1.0, 2, facing, Shading::smooth);
    const Scene scene = builder.finish();
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
      ASSERT_NE(scene.vertices[i].normal, kNone);
      EXPECT_GT(glm::dot(unpackNormal(scene.vertices[i].normal), sign * scene.positions[i]), 0.9999f);
    }
  }
}

TEST(SceneBuilder, FlatShapesHaveNoNormals) {
  SceneBuilder builder;
  builder.icosphere(builder.material(diffuse(vec3(0.5f))), {0, 0, 0}, 1.0, 1, Facing::outside, Shading::flat);
  for (const Vertex& vertex : builder.finish().vertices) EXPECT_EQ(vertex.normal, kNone);
}

TEST(SceneBuilder, QuadSquareAndDiscFaceTheirNormals) {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(1, -2, 0.5));
  SceneBuilder builder;
  const uint material = builder.material(diffuse(vec3(0.5f)));
  builder.square(material, {1, 1, 1}, normal, 2.0, 5);
  builder.disc(material, {1, 1, 1}, normal, 3.0, 24);
  const Scene scene = builder.finish();
  EXPECT_EQ(scene.triangles.size(), 50u + 24u);
  double area = 0;
  for (const Triangle& t : scene.triangles) {
    const glm::dvec3 a(scene.positions[t.v0]), b(scene.positions[t.v1]), c(scene.positions[t.v2]);
    const glm::dvec3 cross = glm::cross(b - a, c - a);
    EXPECT_GT(glm::dot(glm::normalize(cross), normal), 1 - 1e-5);
    area += 0.5 * glm::length(cross);
  }
  EXPECT_NEAR(area, 4.0 + 12 * std::sin(2 * kPi / 24) * 9.0, 1e-4);
}

TEST(SceneBuilder, EmittersBecomeLights) {
  SceneBuilder builder;
  const uint wall = builder.material(diffuse(vec3(0.5f)));
  const uint lamp = builder.material(emitter(vec3(1, 2, 3)));
  const uint panel = builder.material(emitter(vec3(2), true));
  builder.quad(wall, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  builder.quad(lamp, {0, 0, 1}, {2, 0, 0}, {0, 3, 0});
  builder.quad(panel, {0, 0, 2}, {1, 0, 0}, {0, 1, 0});
  const Scene scene = builder.finish();
  ASSERT_EQ(scene.lights.size(), 4u);
  ASSERT_EQ(scene.lightOfTriangle.size(), 6u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(scene.lightOfTriangle[i], kNone);
  for (uint i = 0; i < 4; ++i) {
    EXPECT_EQ(scene.lightOfTriangle[i + 2], i);
    EXPECT_EQ(scene.lights[i].triangle, i + 2);
  }
  EXPECT_NEAR(scene.lights[0].power + scene.lights[1].power, kPi * 6 * 2, 1e-4);
  EXPECT_NEAR(scene.lights[2].power + scene.lights[3].power, 2 * kPi * 2, 1e-4);
}

TEST(SceneBuilder, PunctualLightsAndEnvironmentHaveTheirPower) {
  SceneBuilder builder;
  builder.box(builder.material(diffuse(vec3(0.5f))), {-1, -1, -1}, {1, 1, 1}, Facing::outside);
  builder.pointLight({0, 2, 0}, vec3(3));
  builder.spotLight({0, 5, 0}, {0, -2, 0}, vec3(1), 0.2, 0.4);
  builder.directionalLight({0, -1, 0}, vec3(2));
  builder.environment(vec3(0.5f));
  const Scene scene = builder.finish();
  ASSERT_EQ(scene.lights.size(), 4u);
  EXPECT_NEAR(scene.lights[0].power, 12 * kPi, 1e-4);
  EXPECT_FLOAT_EQ(scene.lights[1].power, spotPower(vec3(1), std::cos(0.2f), std::cos(0.4f)));
  EXPECT_EQ(scene.lights[1].direction, vec3(0, -1, 0));
  EXPECT_NEAR(scene.lights[2].power, 2 * kPi * 3, 1e-4);  // a disc of the bounding sphere, radius sqrt(3)
  EXPECT_EQ(scene.lights[3].kind, kLightEnvironment);
  EXPECT_NEAR(scene.lights[3].power, 0.5 * 4 * kPi * kPi * 3, 1e-4);
  EXPECT_TRUE(scene.lightOfTriangle.empty());
}

TEST(SceneBuilder, CameraLooksAtItsTargetAndIsUpright) {
  SceneBuilder builder;
  builder.box(builder.material(diffuse(vec3(0.5f))), {-1, -1, -1}, {1, 1, 1}, Facing::inside);
  builder.camera({3, 4, 5}, {-1, 0.5, 2}, 0.7, 320, 200);
  const Scene scene = builder.finish();
  ASSERT_EQ(scene.cameras.size(), 1u);
  const glm::dmat4& m = scene.cameras[0].worldFromCamera;
  const glm::dvec3 view = glm::normalize(glm::dvec3(-1, 0.5, 2) - glm::dvec3(3, 4, 5));
  EXPECT_NEAR(glm::dot(-glm::dvec3(m[2]), view), 1.0, 1e-14);
  EXPECT_GT(m[1].y, 0.0);
  EXPECT_NEAR(m[0].y, 0.0, 1e-15);
  EXPECT_NEAR(glm::determinant(m), 1.0, 1e-14);
  EXPECT_DOUBLE_EQ(scene.cameras[0].aspectRatio, 1.6);
}

SceneBuilder smallScene() {
  SceneBuilder builder;
  builder.box(builder.material(diffuse(vec3(0.5f))), {-1.1, -1.3, -1}, {1.7, 1, 1}, Facing::inside, 2);
  builder.icosphere(builder.material(glass(1.5f)), {0.3, 0.1, 0}, 0.35, 2, Facing::outside, Shading::smooth);
  builder.pointLight({0.2, 0.7, 0.1}, vec3(3));
  builder.camera({0.9, 0, 0.9}, {0, 0, 0}, 0.9, 64, 64);
  return builder;
}

TEST(SceneBuilder, ScalingByAPowerOfTwoScalesPositionsExactly) {
  SceneBuilder builder = smallScene();
  const Scene scene = builder.finish();
  for (const int k : {-13, 5, 20}) {
    builder.transform(glm::scale(glm::dmat4(1.0), glm::dvec3(std::ldexp(1.0, k))));
    const Scene scaled = builder.finish();
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
      ASSERT_EQ(scaled.positions[i], scene.positions[i] * std::ldexp(1.0f, k));
      ASSERT_EQ(scaled.vertices[i].normal, scene.vertices[i].normal);
    }
    EXPECT_EQ(scaled.lights[0].position, scene.lights[0].position * std::ldexp(1.0f, k));
    EXPECT_NEAR(glm::determinant(scaled.cameras[0].worldFromCamera), 1.0, 1e-12);
  }
}

TEST(SceneBuilder, KeepsItsPrecisionFarFromTheOrigin) {
  SceneBuilder builder = smallScene();
  const Scene scene = builder.finish();
  const glm::dvec3 offset(3e5, -2e5, 1e5);
  builder.transform(glm::translate(glm::dmat4(1.0), offset));
  const Scene moved = builder.finish();
  for (std::size_t i = 0; i < scene.positions.size(); ++i) {
    const glm::dvec3 world = glm::dvec3(moved.positions[i]) + moved.worldFromRender;
    EXPECT_LT(glm::length(world - offset - glm::dvec3(scene.positions[i])), 1e-6);
  }
  const glm::dvec3 light = glm::dvec3(moved.lights[0].position) + moved.worldFromRender - offset;
  EXPECT_LT(glm::length(light - glm::dvec3(0.2, 0.7, 0.1)), 1e-6);
}

TEST(SceneBuilder, RotationTurnsNormalsAndCamera) {
  SceneBuilder builder = smallScene();
  const Scene scene = builder.finish();
  const glm::dmat4 rotation = glm::rotate(glm::dmat4(1.0), 1.1, glm::normalize(glm::dvec3(1, 2, -1)));
  builder.transform(rotation);
  const Scene turned = builder.finish();
  for (std::size_t i = 0; i < scene.vertices.size(); ++i) {
    if (scene.vertices[i].normal == kNone) continue;
    const glm::dvec3 expected = glm::dmat3(rotation) * glm::dvec3(unpackNormal(scene.vertices[i].normal));
    EXPECT_GT(glm::dot(glm::dvec3(unpackNormal(turned.vertices[i].normal)), expected), 1 - 1e-6);
  }
  const glm::dmat4 expected = rotation * scene.cameras[0].worldFromCamera;
  for (int c = 0; c < 4; ++c) EXPECT_LT(glm::length(turned.cameras[0].worldFromCamera[c] - expected[c]), 1e-12);
}

TEST(SceneBuilder, RefusesAnEmptyScene) { EXPECT_THROW(static_cast<void>(SceneBuilder().finish()), std::logic_error); }

TEST(SceneBuilder, SolidGlassAndThinGlassDifferInTheirFlag) {
  EXPECT_EQ(glass(1.33f).flags & kMaterialSolid, kMaterialSolid);
  EXPECT_EQ(thinGlass(1.33f).flags & kMaterialSolid, 0u);
  EXPECT_EQ(glass(1.33f, vec3(1, 2, 3)).absorption, vec3(1, 2, 3));
}

}  // namespace
}  // namespace importon::test
