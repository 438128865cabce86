#include "scene/geometry.h"

#include <gtest/gtest.h>

#include "loader/load.h"
#include "support/stability.h"

namespace importon::test {
namespace {

TEST(RenderSpace, OrdinaryScenesKeepTheirCoordinates) {
  EXPECT_EQ(chooseOrigin({-1, 0, -1}, {1, 2, 1}), glm::dvec3(0));
  EXPECT_EQ(chooseOrigin({3, 3, 3}, {4, 4, 4}), glm::dvec3(0));
}

TEST(RenderSpace, FarScenesAreMovedToTheOrigin) {
  const glm::dvec3 centre(1e7 + 0.25, -3e6, 12345.678);
  const glm::dvec3 origin = chooseOrigin(centre - 1.0, centre + 1.0);
  EXPECT_LT(glm::length(origin - centre), 1.0);
  EXPECT_EQ(origin, glm::dvec3(vec3(origin))) << "not representable as float";
}

TEST(RenderSpace, PowersOfTwoScaleEverythingExactly) {
  for (const glm::dvec3& low : {glm::dvec3(0.3, 0.7, -0.1), glm::dvec3(1e5 + 0.3, 4e5, 7.1)}) {
    const glm::dvec3 high = low + glm::dvec3(1.1, 2.3, 0.7);
    for (int k = -13; k <= 20; ++k) {
      const double scale = std::ldexp(1.0, k);
      EXPECT_EQ(chooseOrigin(low * scale, high * scale), chooseOrigin(low, high) * scale) << k;
    }
  }
}

/// A triangle whose node stands at `translation` and is scaled by `scale`.
Scene placed(const glm::dvec3& translation, double scale) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.primitive()["attributes"]["POSITION"] =
      builder.addPositions({{0.1f, 0.2f, 0.3f}, {1.3f, 0.1f, 0.2f}, {0.4f, 1.7f, 0.9f}});
  const glm::dvec3 t = translation * scale;
  builder.json["nodes"][0]["translation"] = {t.x, t.y, t.z};
  builder.json["nodes"][0]["scale"] = {scale, scale, scale};
  return load(builder);
}

TEST(RenderSpace, AScaledSceneHasScaledPositionsBitForBit) {
  for (const glm::dvec3& translation : {glm::dvec3(0.0), glm::dvec3(123456.7, -654.3, 1e5)}) {
    const Scene unit = placed(translation, 1.0);
    for (int k = -13; k <= 20; ++k) {
      const double scale = std::ldexp(1.0, k);
      const Scene scaled = placed(translation, scale);
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(scaled.positions[i], unit.positions[i] * static_cast<float>(scale)) << k;
      }
      EXPECT_EQ(scaled.worldFromRender, unit.worldFromRender * scale);
      EXPECT_EQ(scaled.lights[0].area, unit.lights[0].area * static_cast<float>(scale * scale));
      EXPECT_EQ(scaled.lights[0].power, unit.lights[0].power * static_cast<float>(scale * scale));
    }
  }
}

TEST(RenderSpace, AFarSceneKeepsItsShape) {
  const Scene near = placed(glm::dvec3(0.0), 1.0);
  const Scene far = placed(glm::dvec3(1e8, 0, 0), 1.0);
  EXPECT_NE(far.worldFromRender, glm::dvec3(0.0));
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 nearWorld(near.positions[i]);
    const glm::dvec3 farWorld = glm::dvec3(far.positions[i]) + far.worldFromRender - glm::dvec3(1e8, 0, 0);
    EXPECT_LT(glm::length(nearWorld - farWorld), 1e-6);
  }
}

TEST(DegenerateTriangles, AreDroppedWithACount) {
  StabilityCase listed(12, "triangles without area", "a counted warning, the rest unchanged");
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const int positions = builder.addPositions({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0.5f, 0}});
  const int indices = builder.addIndices({0, 1, 2, 0, 1, 1, 0, 1, 3});
  builder.addMesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"material", 0}});
  Log log(Log::Verbosity::quiet);
  const Scene scene = load(builder.glb(), log);
  EXPECT_EQ(scene.triangles.size(), 2u);
  ASSERT_EQ(log.warnings().size(), 1u);
  EXPECT_NE(log.warnings()[0].message.find("2 triangles without area"), std::string::npos);
  listed.note("dropped, counted", 1);
}

TEST(DegenerateTriangles, ThinNeedlesStay) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.primitive()["attributes"]["POSITION"] = builder.addPositions({{0, 0, 0}, {1, 0, 0}, {0.5f, 1e-6f, 0}});
  EXPECT_EQ(load(builder).triangles.size(), 1u);
}

TEST(NonFiniteTriangles, AreDroppedWithACountAndTheRestStays) {
  StabilityCase listed(12, "NaN and infinite vertices", "a counted warning, the rest unchanged");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const int positions =
      builder.addPositions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {nan, 0, 0}, {0, infinity, 0}, {0, 0, 1e30f}});
  const int indices = builder.addIndices({0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 1, 5});
  builder.addMesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"material", 0}});
  Log log(Log::Verbosity::quiet);
  const Scene scene = load(builder.glb(), log);
  EXPECT_EQ(scene.triangles.size(), 2u);
  ASSERT_EQ(log.warnings().size(), 1u);
  EXPECT_NE(log.warnings()[0].message.find("3 triangles with a corner"), std::string::npos);
  EXPECT_EQ(scene.boundsMax, vec3(1, 1, 0));
  for (const vec3& position : scene.positions) EXPECT_TRUE(std::isfinite(glm::length(position)));
  listed.note("dropped, counted, the rest unchanged", 1);
}

TEST(NonFiniteTriangles, AloneAreNoScene) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["nodes"][0]["scale"] = {0, 0, 0};
  EXPECT_NE(errorOf(builder).find("no triangle is left"), std::string::npos);
}

TEST(SceneSize, InstancesCannotMultiplyWithoutBound) {
  constexpr std::size_t kTriangles = 100000;
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  std::vector<std::uint16_t> indices;
  for (std::size_t i = 0; i < kTriangles; ++i) indices.insert(indices.end(), {0, 1, 2});
  builder.primitive()["indices"] = builder.addIndices(indices);
  for (int i = 0; i < 700; ++i) builder.addRoot({{"mesh", 0}});
  EXPECT_NE(errorOf(builder).find("more than 67108864 triangles"), std::string::npos);
}

}  // namespace
}  // namespace importon::test
