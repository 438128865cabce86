/// EXT_lights_ies: files of LM-63, and the lights that have them.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "loader/load.h"
#include "scene/profiles/light_profile.h"
#include "support/temporary_folder.h"

namespace importon::test::profile_light_test {
namespace {

constexpr double kPi = glm::pi<double>();

/// A file of these angles and values; `head` is what stands before the numbers.
std::string ies(const std::string& vertical, const std::string& horizontal, const std::string& candela, int type = 1,
                const std::string& head = "IESNA:LM-63-2002\r\n[TEST] TILT=no\r\nTILT=NONE\r\n") {
  const auto count = [](const std::string& numbers) { return 1 + std::ranges::count(numbers, ' '); };
  return head + "1 1000 2 " + std::to_string(count(vertical)) + " " + std::to_string(count(horizontal)) + " " +
         std::to_string(type) + " 2 0 0 0\r\n0.5 1 60\r\n" + vertical + "\r\n" + horizontal + "\r\n" + candela + "\r\n";
}

IesProfile profileOf(const std::string& text) { return parseIes(toBytes(text), "lamp.ies"); }

std::string errorOfFile(const std::string& text) {
  try {
    (void)profileOf(text);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

/// Of photometry of type C, angles in degrees.
glm::dvec3 along(double vertical, double horizontal) {
  const double v = glm::radians(vertical), h = glm::radians(horizontal);
  return {std::sin(v) * std::cos(h), std::sin(v) * std::sin(h), -std::cos(v)};
}

TEST(IesFile, OfOnePlaneIsAlikeAllAround) {
  const IesProfile profile = profileOf(ies("0 45 90", "0", "100 60 0"));
  EXPECT_TRUE(profile.isAxial());
  for (const double around : {0.0, 77.0, 200.0, 359.0}) {
    EXPECT_NEAR(profile.intensity(along(0, around)), 100, 1e-9);
    EXPECT_NEAR(profile.intensity(along(15, around)), 100 - 40.0 / 3, 1e-9);
    EXPECT_NEAR(profile.intensity(along(67.5, around)), 30, 1e-6);
    EXPECT_EQ(profile.intensity(along(91, around)), 0);
  }
}

/// Planes that the file leaves out are those on the other side of its planes of symmetry.
TEST(IesFile, PlanesThatAreLeftOutMirrorOthers) {
  struct Case {
    std::string horizontal, candela;
    double asked, like;
  };
  for (const Case& c : {Case{"0 90", "1 1 3 3", 120, 60}, Case{"0 90", "1 1 3 3", 210, 30},
                        Case{"0 90", "1 1 3 3", 300, 60}, Case{"0 90 180", "1 1 3 3 9 9", 200, 160},
                        Case{"0 90 180", "1 1 3 3 9 9", 300, 60}, Case{"90 180 270", "1 1 3 3 9 9", 30, 150},
                        Case{"90 180 270", "1 1 3 3 9 9", 350, 190}, Case{"0 180 360", "1 1 3 3 1 1", 270, 90}}) {
    const IesProfile profile = profileOf(ies("0 90", c.horizontal, c.candela));
    EXPECT_FALSE(profile.isAxial());
    EXPECT_NEAR(profile.intensity(along(45, c.asked)), profile.intensity(along(45, c.like)), 1e-9)
        << c.horizontal << ": " << c.asked;
  }
  const IesProfile whole = profileOf(ies("0 90", "0 90 180 270 360", "1 1 2 2 3 3 4 4 1 1"));
  for (const double around : {0.0, 90.0, 180.0, 270.0})
    EXPECT_NEAR(whole.intensity(along(30, around)), 1 + around / 90, 1e-9) << around;
  EXPECT_NEAR(whole.intensity(along(30, 315)), 2.5, 1e-9);
}

/// Planes around x; vertical angles go towards it.
TEST(IesFile, OfTypeBTurnsAroundTheHorizontalAxis) {
  const IesProfile profile = profileOf(ies("-90 0 90", "-90 0 90", "1 5 2 1 9 2 1 7 2", 2));
  EXPECT_NEAR(profile.intensity({0, 0, -1}), 9, 1e-9);
  EXPECT_NEAR(profile.intensity({1, 0, 0}), 2, 1e-9);
  EXPECT_NEAR(profile.intensity({-1, 0, 0}), 1, 1e-9);
  EXPECT_NEAR(profile.intensity({0, 1, 0}), 5, 1e-9);
  EXPECT_NEAR(profile.intensity({0, -1, 0}), 7, 1e-9);
  EXPECT_EQ(profile.intensity(glm::normalize(glm::dvec3(0, 0.1, 1))), 0);
  const IesProfile quarter = profileOf(ies("0 90", "0 90", "9 2 7 2", 2));
  EXPECT_NEAR(quarter.intensity({-1, 0, 0}), 2, 1e-9);
  EXPECT_NEAR(quarter.intensity({0, 1, 0}), 7, 1e-9);
}

TEST(IesFile, HasFormsOfAllVersions) {
  for (const char* head :
       {"IESNA91\nTILT=NONE\n", "TILT=NONE\n", "IES:LM-63-2019\n[_X] 1 2 3\nTILT=lamp.tlt\n",
        "IESNA:LM-63-1995\nTILT=INCLUDE\n1\n3\n0 45 90\n1 0.9 0.8\n", "IESNA:LM-63-1995\n  TILT=NONE  \n"}) {
    EXPECT_NEAR(profileOf(ies("0 90", "0", "8 +4e0", 1, head)).intensity({0, 0, -1}), 8, 1e-9) << head;
  }
  std::string commas = ies("0 90", "0", "8 4");
  std::ranges::replace(commas.begin() + 40, commas.end(), ' ', ',');
  EXPECT_NEAR(profileOf(commas).intensity({0, 0, -1}), 8, 1e-9);
}

TEST(IesFile, IsRefusedWhereItIsDamaged) {
  EXPECT_NE(errorOfFile("").find("no line TILT="), std::string::npos);
  EXPECT_NE(errorOfFile("\x89PNG\n").find("no IES file"), std::string::npos);
  EXPECT_NE(errorOfFile(ies("0 90", "0", "8")).find("cut off (lamp.ies)"), std::string::npos);
  EXPECT_NE(errorOfFile(ies("0 90", "0", "8 x")).find("something else for a number"), std::string::npos);
  EXPECT_NE(errorOfFile(ies("0 90", "0", "8 nan")).find("something else for a number"), std::string::npos);
  EXPECT_NE(errorOfFile(ies("90 0", "0", "8 8")).find("not in order"), std::string::npos);
  EXPECT_NE(errorOfFile(ies("0 90", "0", "8 8", 3)).find("type number 3"), std::string::npos);
  for (const char* counts : {"99999 99999", "1e9 1", "0 1", "1 -1", "1.5 1"}) {
    const std::string error = errorOfFile(std::string("TILT=NONE\n1 1 1 ") + counts + " 1 1 0 0 0 1 1 1\n0\n0\n1\n");
    EXPECT_NE(error, "") << counts;
  }
}

/// Values of nothing, of negative light and of too much stay numbers.
TEST(IesFile, ValuesAreBounded) {
  EXPECT_EQ(profileOf(ies("0 90", "0", "-5 0")).intensity({0, 0, -1}), 0);
  EXPECT_EQ(profileOf(ies("0 90", "0", "1e300 0")).intensity({0, 0, -1}), 1e18);
  EXPECT_EQ(sampleProfile(profileOf(ies("0 90", "0", "0 0"))).most, 0);
}

/// A lamp of Lambert's law downwards: I cos, whose integral is pi.
TEST(LightProfile, IntegratesItsShares) {
  std::string angles, candela;
  for (int angle = 0; angle <= 90; angle += 2) {
    angles += (angle == 0 ? "" : " ") + std::to_string(angle);
    candela += (angle == 0 ? "" : " ") + std::to_string(std::max(70 * std::cos(glm::radians(double(angle))), 0.0));
  }
  const LightProfile profile = sampleProfile(profileOf(ies(angles, "0", candela)));
  EXPECT_NEAR(profile.most, 70, 0.01);
  EXPECT_NEAR(profile.shareIntegral, kPi, 2e-3);
  EXPECT_NEAR(profile.cosOuter, 0, 0.02);
  EXPECT_LE(profile.cosOuter, 0.0f);
  EXPECT_EQ(profile.width, 1);
}

GltfBuilder lamp(const std::string& file, const Json& use = {}, const Json& node = Json::object()) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["materials"][0].erase("emissiveFactor");
  builder.json["extensionsUsed"] = {"EXT_lights_ies"};
  builder.json["extensionsRequired"] = {"EXT_lights_ies"};
  const int view = builder.addView(file.data(), file.size());
  builder.json["extensions"]["EXT_lights_ies"]["lights"] = {
      {{"bufferView", view}, {"mimeType", "application/x-ies-lm-63"}}};
  Json placed = node;
  placed["extensions"]["EXT_lights_ies"] = use;
  placed["extensions"]["EXT_lights_ies"]["light"] = 0;
  builder.addRoot(placed);
  return builder;
}

TEST(ProfileLight, StandsAndShinesAsItsNodeSays) {
  const Scene scene = load(lamp(ies("0 90", "0", "50 50"), {{"multiplier", 2}, {"color", {1, 0.5, 0}}},
                                {{"translation", {1, 2, 3}}, {"scale", {2, 2, 2}}}));
  ASSERT_EQ(scene.lights.size(), 1u);
  const Light& light = scene.lights[0];
  EXPECT_EQ(light.kind, kLightProfile);
  EXPECT_EQ(light.position, vec3(1, 2, 3));
  EXPECT_EQ(light.direction, vec3(0, 0, -1));
  EXPECT_EQ(light.emission, vec3(100, 50, 0));
  EXPECT_NEAR(light.power, 50 * 2 * kPi, 0.01 * 50 * 2 * kPi);
  EXPECT_EQ(scene.textures.at(light.triangle).height, 360u);
  EXPECT_EQ(scene.texels.size(), 2u * 360);
}

TEST(ProfileLight, OneProfileServesMany) {
  GltfBuilder builder = lamp(ies("0 90", "0 90", "50 50 3 3"));
  builder.addRoot({{"translation", {1, 0, 0}}, {"extensions", {{"EXT_lights_ies", {{"light", 0}}}}}});
  const Scene scene = load(builder);
  EXPECT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.texels.size(), 2u * 360 * 360);
}

TEST(ProfileLight, WithoutLightIsNone) {
  EXPECT_NE(errorOf(lamp(ies("0 90", "0", "0 0"))).find("no light"), std::string::npos);
  EXPECT_NE(errorOf(lamp(ies("0 90", "0", "5 5"), {{"multiplier", 0}})).find("no light"), std::string::npos);
}

TEST(ProfileLight, MayBeAFile) {
  const TemporaryFolder folder;
  GltfBuilder builder = lamp(ies("0 90", "0", "5 5"));
  Json& profile = builder.json["extensions"]["EXT_lights_ies"]["lights"][0];
  const std::string text = ies("0 90", "0", "7 7");
  profile = {{"uri", "data:application/x-ies-lm-63;base64," + base64(toBytes(text))}};
  EXPECT_EQ(load(builder).lights.at(0).emission, vec3(7));
  profile = {{"uri", "lamp.ies"}};
  writeFile(folder / "lamp.ies", ies("0 90", "0", "9 9"));
  const Bytes glb = builder.glb();
  Log log(Log::Verbosity::quiet);
  writeFile(folder / "scene.glb", std::string(glb.begin(), glb.end()));
  EXPECT_EQ(loadGltf(folder / "scene.glb", log).lights.at(0).emission, vec3(9));
}

TEST(ProfileLight, IsRefusedByItsPlace) {
  EXPECT_NE(errorOf(lamp("nothing")).find("(test.glb#/extensions/EXT_lights_ies/lights/0)"), std::string::npos);
  GltfBuilder builder = lamp(ies("0 90", "0", "5 5"));
  builder.json["nodes"][1]["extensions"]["EXT_lights_ies"]["light"] = 1;
  EXPECT_NE(errorOf(builder).find("index 1 is not among the 1"), std::string::npos);
  builder.json["nodes"][1]["extensions"]["EXT_lights_ies"]["light"] = 0;
  builder.json["extensions"]["EXT_lights_ies"]["lights"][0] = Json::object();
  EXPECT_NE(errorOf(builder).find("neither 'uri' nor 'bufferView'"), std::string::npos);
}

}  // namespace
}  // namespace importon::test::profile_light_test
