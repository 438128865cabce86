#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

#include "loader/image_builder.h"
#include "loader/load.h"
#include "scene/light_math.h"
#include "scene/lights.h"

namespace importon::test {
namespace {

/// A file whose only light is a punctual one, at a node that `node` places.
GltfBuilder punctual(const Json& light, Json node = Json::object()) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["materials"][0]["emissiveFactor"] = {0, 0, 0};
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({light});
  node["extensions"]["KHR_lights_punctual"]["light"] = 0;
  builder.addRoot(node);
  return builder;
}

TEST(EmissiveTriangles, AreLambertianLights) {
  const Scene scene = load(GltfBuilder::emissiveTriangle());
  ASSERT_EQ(scene.lights.size(), 1u);
  const Light& light = scene.lights[0];
  EXPECT_EQ(light.kind, kLightTriangle);
  EXPECT_EQ(light.triangle, 0u);
  EXPECT_EQ(light.area, 0.5f);
  EXPECT_EQ(light.emission, vec3(1, 2, 3));
  EXPECT_NEAR(light.power, kPi * 0.5 * 2, 1e-6);
  EXPECT_EQ(scene.lightOfTriangle, std::vector<uint>{0});
}

TEST(EmissiveTriangles, DoubleSidedOnesEmitTwice) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const float single = load(builder).lights[0].power;
  builder.json["materials"][0]["doubleSided"] = true;
  EXPECT_EQ(load(builder).lights[0].power, 2 * single);
}

TEST(EmissiveTriangles, OthersHaveNoLight) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.addMesh({{"attributes", {{"POSITION", 0}}}});
  EXPECT_EQ(load(builder).lightOfTriangle, (std::vector<uint>{0, kNone}));
}

/// Two triangles of one emissive texture: the first on its white half, the second on its black half.
GltfBuilder halfLit() {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const int texture = builder.addTexture(makePng(2, 1, {188, 188, 188, 255, 0, 0, 0, 255}));
  builder.json["materials"][0]["emissiveTexture"]["index"] = texture;
  const auto uvs = [&](float left) {
    return builder.addAccessor(std::vector<glm::vec2>{{left, 0}, {left + 0.4f, 0}, {left, 1}}, kFloat, "VEC2");
  };
  builder.primitive()["attributes"]["TEXCOORD_0"] = uvs(0.05f);
  builder.addMesh({{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", uvs(0.55f)}}}, {"material", 0}});
  return builder;
}

TEST(EmissiveTriangles, EmitTheMeanOfTheirTextureAndNothingWhereItIsBlack) {
  const Scene scene = load(halfLit());
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lightOfTriangle, (std::vector<uint>{0, kNone}));
  EXPECT_LT(glm::length(scene.lights[0].emission - vec3(1, 2, 3) * 0.502886f), 1e-4f);  // 188 decoded from sRGB
}

/// One emissive triangle whose right half, by its UVs, is transparent.
GltfBuilder cutLamp(const char* alphaMode) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const int texture = builder.addTexture(makePng(2, 1, {255, 255, 255, 255, 255, 255, 255, 51}));
  builder.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = texture;
  builder.json["materials"][0]["alphaMode"] = alphaMode;
  builder.primitive()["attributes"]["TEXCOORD_0"] =
      builder.addAccessor(std::vector<glm::vec2>{{0, 0}, {0.5f, 0}, {1, 0}}, kFloat, "VEC2");
  return builder;
}

TEST(EmissiveTriangles, EmitWhatAlphaLeavesOfThem) {
  const auto emissionOf = [](const char* mode) { return load(cutLamp(mode)).lights.at(0).emission.x; };
  EXPECT_EQ(emissionOf("OPAQUE"), 1);
  EXPECT_NEAR(emissionOf("MASK"), 0.5, 0.05);
  EXPECT_NEAR(emissionOf("BLEND"), 0.5 + 0.5 * 0.2, 0.05);
}

TEST(EmissiveTriangles, AreNoLightsWhereAlphaLeavesNothing) {
  GltfBuilder builder = cutLamp("MASK");
  builder.addMesh({{"attributes", {{"POSITION", 0}}}});
  builder.json["materials"].push_back(builder.json["materials"][0]);
  builder.json["materials"][0]["alphaCutoff"] = 1.5;
  builder.addMesh({{"attributes", {{"POSITION", 0}}}, {"material", 1}});
  const Scene scene = load(builder);
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lightOfTriangle.at(0), kNone);
}

TEST(PunctualLights, PointLightsShineByFourPi) {
  const Scene scene = load(punctual({{"type", "point"}, {"color", {1, 0.5, 0}}, {"intensity", 6}},
                                    {{"translation", {1, 2, 3}}, {"scale", {5, 5, 5}}}));
  ASSERT_EQ(scene.lights.size(), 1u);
  const Light& light = scene.lights[0];
  EXPECT_EQ(light.kind, kLightPoint);
  EXPECT_EQ(light.triangle, kNone);
  EXPECT_EQ(light.position, vec3(1, 2, 3));
  EXPECT_EQ(light.emission, vec3(6, 3, 0));
  EXPECT_NEAR(light.power, 4 * kPi * 3, 1e-5);
  EXPECT_TRUE(scene.lightOfTriangle.empty());
}

TEST(PunctualLights, DefaultsAreWhiteOfOneCandela) {
  const Light light = load(punctual({{"type", "point"}})).lights.at(0);
  EXPECT_EQ(light.emission, vec3(1));
}

TEST(PunctualLights, SpotLightsLookAlongMinusZ) {
  const double half = std::sqrt(0.5);
  const Light light = load(punctual({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.5}}}},
                                    {{"rotation", {0, half, 0, half}}}))
                          .lights.at(0);
  EXPECT_EQ(light.kind, kLightSpot);
  EXPECT_LT(glm::length(light.direction - vec3(-1, 0, 0)), 1e-6f);
  EXPECT_NEAR(light.cosInner, std::cos(0.2), 1e-6);
  EXPECT_NEAR(light.cosOuter, std::cos(0.5), 1e-6);
}

TEST(PunctualLights, SpotConesHaveTheDefaultsOfTheExtension) {
  const Light light = load(punctual({{"type", "spot"}, {"spot", Json::object()}})).lights.at(0);
  EXPECT_EQ(light.cosInner, 1);
  EXPECT_NEAR(light.cosOuter, std::sqrt(0.5), 1e-6);
}

TEST(PunctualLights, SpotPowerIsTheIntegralOverTheCone) {
  const double inner = 0.3;
  const double outer = 0.9;
  double sum = 0;
  constexpr int kSteps = 200000;
  for (int i = 0; i < kSteps; ++i) {  // midpoints in the polar angle
    const double theta = (i + 0.5) / kSteps * outer;
    const double ramp = std::clamp((std::cos(theta) - std::cos(outer)) / (std::cos(inner) - std::cos(outer)), 0.0, 1.0);
    sum += 2 * kPi * ramp * ramp * std::sin(theta) * outer / kSteps;
  }
  const float power = spotPower(vec3(7), static_cast<float>(std::cos(inner)), static_cast<float>(std::cos(outer)));
  EXPECT_NEAR(power, 7 * sum, 1e-4);
}

TEST(PunctualLights, SharpConesCanBeDividedBy) {
  const Light light =
      load(punctual({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.4}, {"outerConeAngle", 0.4}}}})).lights.at(0);
  EXPECT_GT(light.cosInner, light.cosOuter);
  const Light narrow =
      load(punctual({{"type", "spot"}, {"spot", {{"innerConeAngle", 0}, {"outerConeAngle", 1e-6}}}})).lights.at(0);
  EXPECT_GT(narrow.cosInner, narrow.cosOuter);
}

TEST(PunctualLights, DirectionalPowerIsWhatTheSceneReceives) {
  const Scene scene = load(punctual({{"type", "directional"}, {"intensity", 10}}));
  const Light& light = scene.lights.at(0);
  EXPECT_EQ(light.kind, kLightDirectional);
  EXPECT_EQ(light.direction, vec3(0, 0, -1));
  EXPECT_NEAR(light.power, 10 * kPi * 0.5, 1e-5);  // half diagonal of the unit triangle: sqrt(1/2)
}

TEST(PunctualLights, RefusesWhatIsNone) {
  EXPECT_NE(errorOf(punctual({{"type", "laser"}}), kStrict)
                .find("'laser' is none of point, spot, directional "
                      "(test.glb#/extensions/KHR_lights_punctual/lights/0/type)"),
            std::string::npos);
  EXPECT_NE(errorOf(punctual({{"color", {1, 1, 1}}})).find("'type' is missing"), std::string::npos);
  EXPECT_NE(errorOf(punctual({{"type", "spot"}})).find("'spot' is missing"), std::string::npos);
  const Json cone = {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.4}}}};
  EXPECT_NE(errorOf(punctual(cone), kStrict).find("cone angles"), std::string::npos);
  const Json wide = {{"type", "spot"}, {"spot", {{"outerConeAngle", 3}}}};
  EXPECT_NE(errorOf(punctual(wide), kStrict).find("cone angles"), std::string::npos);
  EXPECT_NE(errorOf(punctual({{"type", "point"}}, {{"scale", {0, 0, 0}}})).find("scale 0"), std::string::npos);
  GltfBuilder missing = punctual({{"type", "point"}});
  missing.json["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 1;
  EXPECT_NE(errorOf(missing).find("index 1 is not among the 1 extensions/KHR_lights_punctual/lights"),
            std::string::npos);
}

TEST(Environment, IsALightOfItsOwn) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["materials"][0]["emissiveFactor"] = {0, 0, 0};
  builder.json["scenes"][0]["extras"]["environment"] = {{"type", "constant"}, {"radiance", {1, 2, 3}}};
  const Scene scene = load(builder);
  ASSERT_TRUE(scene.environment);
  EXPECT_EQ(scene.environment->texels, std::vector{vec3(1, 2, 3)});
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].kind, kLightEnvironment);
  EXPECT_EQ(scene.lights[0].emission, vec3(1, 2, 3));
  EXPECT_NEAR(scene.lights[0].power, 4 * kPi * 2 * kPi * 0.5, 1e-4);
}

TEST(Environment, OfAnotherTypeIsPassedOverWithAWarning) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["scenes"][0]["extras"]["environment"] = {{"type", "sky"}};
  Log log(Log::Verbosity::quiet);
  EXPECT_FALSE(load(builder.glb(), log).environment);
  ASSERT_EQ(log.warnings().size(), 1u);
  EXPECT_NE(log.warnings()[0].message.find("'sky'"), std::string::npos);
}

TEST(Environment, BelongsToItsScene) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.add("scenes", {{"extras", {{"environment", {{"type", "constant"}, {"radiance", {1, 2, 3}}}}}}});
  EXPECT_FALSE(load(builder).environment);
}

TEST(Lights, StandInTheOrderTrianglesPunctualEnvironment) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({{{"type", "point"}}});
  builder.addRoot({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  builder.json["scenes"][0]["extras"]["environment"] = {{"type", "constant"}, {"radiance", {1, 1, 1}}};
  const Scene scene = load(builder);
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].kind, kLightTriangle);
  EXPECT_EQ(scene.lights[1].kind, kLightPoint);
  EXPECT_EQ(scene.lights[2].kind, kLightEnvironment);
}

}  // namespace
}  // namespace importon::test
