// Which light shows a scene, and the light of the studio.
#include "scene/studio.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "loader/load.h"
#include "scene/environment.h"
#include "scene/light_math.h"

namespace importon::test {
namespace {

/// A triangle that a camera sees.
GltfBuilder emitting(float red) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const int camera = builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}});
  builder.json["nodes"][0]["camera"] = camera;
  builder.json["materials"][0].erase("extensions");
  builder.json["materials"][0]["emissiveFactor"] = {red, 0, 0};
  return builder;
}

GltfBuilder unlit() { return emitting(0); }

Scene load(const GltfBuilder& builder, const LoadOptions& options) {
  Log log(Log::Verbosity::quiet);
  const Bytes bytes = builder.glb();
  return loadGltfFromMemory(asBytes(bytes), "test.glb", {}, log, options);
}

Scene loadAuto(const GltfBuilder& builder) { return load(builder, {.light = LightChoice::automatic}); }

void addConstantEnvironment(GltfBuilder& builder, float radiance) {
  builder.json["scenes"][0]["extras"]["environment"] = {{"type", "constant"},
                                                        {"radiance", {radiance, radiance, radiance}}};
}

TEST(LightChoice, AutoLightsBySceneOrStudio) {
  EXPECT_TRUE(loadAuto(unlit()).isInStudio);
  const Scene lit = loadAuto(emitting(1));
  EXPECT_FALSE(lit.isInStudio);
  EXPECT_FALSE(lit.environment);
  GltfBuilder environment = unlit();
  addConstantEnvironment(environment, 1e-6f);
  EXPECT_FALSE(loadAuto(environment).isInStudio) << "an environment is seen, however weak";
}

TEST(LightChoice, OfTheSceneFailsWhereThereIsNone) {
  try {
    (void)load(unlit(), {.light = LightChoice::scene});
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("no light"), std::string::npos) << error.what();
  }
  EXPECT_EQ(load(emitting(1), {.light = LightChoice::scene}).lights.size(), 1u);
}

TEST(LightChoice, StudioStandsForTheEnvironmentAlone) {
  GltfBuilder builder = emitting(1);
  addConstantEnvironment(builder, 3);
  const Scene scene = load(builder, {.light = LightChoice::studio});
  EXPECT_TRUE(scene.isInStudio);
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[0].kind, kLightTriangle);
  EXPECT_EQ(scene.lights[1].kind, kLightEnvironment);
  ASSERT_TRUE(scene.environment);
  EXPECT_EQ(scene.environment->texels, studioEnvironment().texels);
}

/// Grey that the emitter lights from all around: 0.18 L against 1 / (255 · 12.92) of an 8-bit sRGB picture.
TEST(LightChoice, EmittersThatWouldShowBlackCountAsNone) {
  constexpr float kLeast = 3 / (0.18f * 255 * 12.92f);  // red, for that mean of three channels
  EXPECT_TRUE(loadAuto(emitting(0.99f * kLeast)).isInStudio);
  EXPECT_FALSE(loadAuto(emitting(1.01f * kLeast)).isInStudio);
  const Scene kept = load(emitting(0.5f * kLeast), {.light = LightChoice::scene});
  EXPECT_FALSE(kept.isInStudio);
  EXPECT_EQ(kept.lights.size(), 1u);
  EXPECT_EQ(loadAuto(emitting(0.5f * kLeast)).lights.size(), 2u) << "they stay beside the studio";
}

/// Without a camera a file is a model: what glows on it is not there to light it. With a lamp it is a scene.
TEST(LightChoice, ModelsThatGlowAreLitByTheStudioToo) {
  GltfBuilder model = emitting(1);
  model.json["nodes"][0].erase("camera");
  const Scene scene = loadAuto(model);
  EXPECT_TRUE(scene.isInStudio);
  EXPECT_EQ(scene.lights.size(), 2u);
  EXPECT_FALSE(load(model, {.light = LightChoice::scene}).isInStudio);
  addConstantEnvironment(model, 1);
  EXPECT_FALSE(loadAuto(model).isInStudio);
}

TEST(LightChoice, ABlackEnvironmentIsNone) {
  GltfBuilder builder = unlit();
  addConstantEnvironment(builder, 0);
  const Scene scene = loadAuto(builder);
  EXPECT_TRUE(scene.isInStudio);
  EXPECT_EQ(scene.lights.size(), 1u);
}

TEST(LightChoice, TurnsTheStudioToo) {
  const Scene scene = load(unlit(), {.light = LightChoice::automatic, .environmentRotation = 90});
  EXPECT_EQ(scene.environment->texels, turned(studioEnvironment(), 90).texels);
}

/// W/m² on a surface of that normal.
double irradiance(const EnvironmentMap& map, const glm::dvec3& normal) {
  double sum = 0;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const glm::dvec3 d = environmentDirection((x + 0.5) / map.width, (y + 0.5) / map.height);
      sum += std::max(glm::dot(d, normal), 0.0) * texelSolidAngle(map, y) *
             meanOf(map.texels[static_cast<std::size_t>(y * map.width + x)]);
    }
  }
  return sum;
}

/// 18 % grey turned to the key has about the radiance 0.18 of middle grey; all sides get some light, none too much.
TEST(Studio, ExposesAGreyModelWell) {
  const EnvironmentMap map = studioEnvironment();
  checkEnvironment(map, "studio");
  EXPECT_NEAR(irradiance(map, glm::normalize(glm::dvec3(-0.5, 0.7, 0.6))), kPi, 0.25 * kPi);
  for (const glm::dvec3& side : {glm::dvec3(1, 0, 0), {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}})
    EXPECT_GT(irradiance(map, side), 0.2 * kPi) << side.x << " " << side.y << " " << side.z;
  EXPECT_LT(irradiance(map, {0, -1, 0}), 0.2 * kPi) << "the floor is dark";
}

TEST(Studio, IsNeutralAndSoft) {
  const EnvironmentMap map = studioEnvironment();
  EXPECT_EQ(map.width, 256);
  EXPECT_EQ(map.height, 128);
  float steepest = 0;
  for (std::size_t i = 0; i < map.texels.size(); ++i) {
    const vec3& texel = map.texels[i];
    EXPECT_TRUE(texel.r == texel.g && texel.g == texel.b);
    EXPECT_GE(texel.r, 0.03f) << "metal never reflects black";
    EXPECT_LE(texel.r, 4.0f) << "no hot spot";
    if (i > 0 && i % 256 != 0) steepest = std::max(steepest, std::abs(texel.r - map.texels[i - 1].r));
  }
  EXPECT_LT(steepest, 1.0f) << "edges fade out over several texels";
}

/// The bright texel, off the centre, stands towards +x, slightly up: column 0.75, row 0.375 of a map 8 x 4.
TEST(TurnedEnvironment, TurnsAsANodeDoes) {
  EnvironmentMap map{8, 4, std::vector<vec3>(32, vec3(0))};
  map.texels[8 + 6] = vec3(8);
  const auto brightest = [](const EnvironmentMap& m) {
    return std::max_element(m.texels.begin(), m.texels.end(), [](const vec3& a, const vec3& b) { return a.x < b.x; }) -
           m.texels.begin();
  };
  // Its left edge is the direction +x. Turned by 90 degrees about +y, +x becomes -z, which is the middle of the map.
  EXPECT_NEAR(environmentDirection(0.75, 0.5).x, 1, 1e-12);
  EXPECT_NEAR(environmentDirection(0.5, 0.5).z, -1, 1e-12);
  EXPECT_EQ(brightest(turned(map, 90)), 8 + 4);
  EXPECT_EQ(brightest(turned(map, -90)), 8 + 0);
  EXPECT_EQ(brightest(turned(map, 360 * 5 + 45)), 8 + 5);
  EXPECT_EQ(turned(map, 360).texels, map.texels);
  EXPECT_EQ(turned(map, -720).texels, map.texels);
}

TEST(TurnedEnvironment, KeepsTheLightOfARowBetweenTexels) {
  EnvironmentMap map{8, 1, {}};
  for (int i = 0; i < 8; ++i) map.texels.emplace_back(static_cast<float>(i * i));
  for (const double degrees : {10.0, -10.0, 200.3, 1e6}) {
    const EnvironmentMap result = turned(map, degrees);
    float before = 0, after = 0;
    for (int i = 0; i < 8; ++i) {
      before += map.texels[static_cast<std::size_t>(i)].x;
      after += result.texels[static_cast<std::size_t>(i)].x;
    }
    EXPECT_NEAR(after, before, 1e-3) << degrees;
  }
  const EnvironmentMap one{1, 1, {vec3(3)}};
  EXPECT_EQ(turned(one, 33).texels, one.texels);
}

}  // namespace
}  // namespace importon::test
