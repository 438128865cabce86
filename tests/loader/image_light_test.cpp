// EXT_lights_image_based as an environment map.
#include <gtest/gtest.h>

#include <cmath>

#include "loader/image_builder.h"
#include "loader/load.h"
#include "scene/environment.h"
#include "scene/light_math.h"

namespace importon::test {
namespace {

GltfBuilder withLight(const Json& light) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["extensionsUsed"].push_back("EXT_lights_image_based");
  builder.json["extensions"]["EXT_lights_image_based"]["lights"] = Json::array({light});
  builder.json["scenes"][0]["extensions"]["EXT_lights_image_based"] = {{"light", 0}};
  return builder;
}

/// Faces of one colour each, as RGBD of alpha 51: five times as bright.
GltfBuilder coloredCube(const Json& more = {}) {
  GltfBuilder builder = withLight({});
  Json faces = Json::array();
  for (unsigned char face = 0; face < 6; ++face) {
    Bytes rgba;
    for (int i = 0; i < 16; ++i)
      rgba.insert(rgba.end(), {static_cast<unsigned char>(face % 2 == 0 ? 255 : 0),
                               static_cast<unsigned char>(face / 2 == 1 ? 255 : 0),
                               static_cast<unsigned char>(face / 2 == 2 ? 255 : 0), 51});
    const Bytes png = makePng(4, 4, rgba);
    faces.push_back(
        builder.add("images", {{"bufferView", builder.addView(png.data(), png.size())}, {"mimeType", "image/png"}}));
  }
  Json& light = builder.json["extensions"]["EXT_lights_image_based"]["lights"][0];
  light = {{"specularImages", Json::array({faces})}, {"specularImageSize", 4}};
  light.update(more.is_null() ? Json::object() : more);
  return builder;
}

/// The texel in a direction, where the middle of a map is -z, its right half +x, its top +y.
vec3 towards(const EnvironmentMap& map, const glm::dvec3& d) {
  const double u = 0.5 + std::atan2(d.x, -d.z) / (2 * kPi), v = std::acos(d.y) / kPi;
  const auto x = std::min(static_cast<int>(u * map.width), map.width - 1),
             y = std::min(static_cast<int>(v * map.height), map.height - 1);
  return map.texels[static_cast<std::size_t>(y * map.width + x)];
}

TEST(ImageLight, ShowsEachFaceWhereItBelongs) {
  const Scene scene = load(coloredCube({{"intensity", 2}}));
  ASSERT_TRUE(scene.environment);
  const glm::dvec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int face = 0; face < 6; ++face) {
    const vec3 expected = 10.0f * vec3(face % 2 == 0, face / 2 == 1, face / 2 == 2);
    const vec3 found = towards(*scene.environment, axes[face]);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-4) << face;
  }
  EXPECT_EQ(scene.lights.back().kind, kLightEnvironment);
}

TEST(ImageLight, TurnsByItsRotation) {
  const double half = std::sqrt(0.5);
  const Scene scene = load(coloredCube({{"rotation", {0, half, 0, half}}}));  // +z goes to +x
  ASSERT_TRUE(scene.environment);
  EXPECT_NEAR(towards(*scene.environment, {1, 0, 0}).z, 5, 1e-4);
  EXPECT_NEAR(towards(*scene.environment, {0, 0, -1}).x, 5, 1e-4);
}

/// A face of which the left half is lit, as seen from inside: -z is ahead, so -x is on the left.
TEST(ImageLight, FacesAreSeenFromInside) {
  GltfBuilder builder = coloredCube();
  Bytes rgb;
  for (int i = 0; i < 256; ++i) rgb.insert(rgb.end(), 3, static_cast<unsigned char>(i % 16 < 8 ? 255 : 0));
  const Bytes jpeg = makeJpeg(16, 16, rgb);
  const int lit =
      builder.add("images", {{"bufferView", builder.addView(jpeg.data(), jpeg.size())}, {"mimeType", "image/jpeg"}});
  for (Json& face : builder.json["extensions"]["EXT_lights_image_based"]["lights"][0]["specularImages"][0]) face = lit;
  const Scene scene = load(builder);
  EXPECT_GT(towards(*scene.environment, glm::normalize(glm::dvec3(-0.6, 0, -1))).x, 0.9f);
  EXPECT_LT(towards(*scene.environment, glm::normalize(glm::dvec3(0.6, 0, -1))).x, 0.1f);
}

TEST(ImageLight, WithoutPicturesIsAsSoftAsItsIrradiance) {
  Json coefficients = Json::array();
  for (int i = 0; i < 9; ++i) coefficients.push_back({0, 0, 0});
  constexpr double kY00 = 0.282095;
  coefficients[0] = {kPi / kY00, 2 * kPi / kY00, 0};  // of radiance 1, 2 and 0 from everywhere
  const GltfBuilder builder = withLight({{"irradianceCoefficients", coefficients}});
  Log log(Log::Verbosity::quiet);
  const Scene scene = load(builder.glb(), log);
  ASSERT_TRUE(scene.environment);
  const vec3 mean = meanRadiance(*scene.environment);
  EXPECT_NEAR(mean.x, 1, 1e-4);
  EXPECT_NEAR(mean.y, 2, 1e-4);
  EXPECT_EQ(mean.z, 0);
  ASSERT_EQ(log.warnings().size(), 1u);
  EXPECT_EQ(log.warnings()[0].kind, "image-based light without pictures");
}

/// The draft KHR_lights_environment names the light "environment", and has cubes of its own, which are not read.
TEST(ImageLight, OfTheDraftIsAsSoftAsItsIrradiance) {
  const auto draft = [](const Json& light, const char* use) {
    GltfBuilder builder = GltfBuilder::emissiveTriangle();
    builder.json["extensionsUsed"].push_back("KHR_lights_environment");
    builder.json["extensions"]["KHR_lights_environment"]["lights"] = Json::array({light});
    builder.json["scenes"][0]["extensions"]["KHR_lights_environment"] = {{use, 0}};
    return builder;
  };
  Json coefficients = Json::array();
  for (int i = 0; i < 9; ++i) coefficients.push_back({i == 0 ? kPi / 0.282095 : 0, 0, 0});
  for (const char* use : {"environment", "light"}) {
    const Scene scene = load(draft({{"irradianceCoefficients", coefficients}, {"intensity", 2}}, use));
    ASSERT_TRUE(scene.environment) << use;
    EXPECT_NEAR(meanRadiance(*scene.environment).x, 2, 1e-4);
  }
  const GltfBuilder cubesAlone = draft({{"specularCubemaps", {0}}}, "environment");
  EXPECT_FALSE(load(cubesAlone).environment);
  ASSERT_EQ(warningsOf(cubesAlone).size(), 1u);
  EXPECT_EQ(warningsOf(cubesAlone)[0].kind, "image-based light that is not read");
}

TEST(ImageLight, RefusesWhatIsNone) {
  EXPECT_NE(errorOf(withLight({{"intensity", -1}}), kStrict).find("/lights/0/intensity"), std::string::npos);
  EXPECT_NE(errorOf(withLight(Json::object())).find("neither six specularImages"), std::string::npos);
  EXPECT_NE(errorOf(coloredCube({{"rotation", {0, 0, 0, 0}}})).find("quaternion"), std::string::npos);
  GltfBuilder missing = withLight({});
  missing.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 1;
  EXPECT_NE(errorOf(missing).find("index 1"), std::string::npos);
  GltfBuilder wrong = coloredCube();
  wrong.json["extensions"]["EXT_lights_image_based"]["lights"][0]["specularImages"][0][3] = 99;
  EXPECT_NE(errorOf(wrong).find("index 99"), std::string::npos);
}

}  // namespace
}  // namespace importon::test
