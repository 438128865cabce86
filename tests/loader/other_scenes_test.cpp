/// Real scenes by other people, those that are in the folder that IMPORTON_OTHER_SCENES names.
#include <gtest/gtest.h>

#include <filesystem>
#include <glm/gtc/constants.hpp>
#include <optional>
#include <string>
#include <vector>

#include "loader/load.h"

namespace importon::test {
namespace {

struct OtherScene {
  const char* name;
  std::size_t triangles;
  int width, height;
  double yfovDegrees;
  glm::dvec3 eye;
  std::size_t emissiveTriangles;
  std::size_t otherLights;
  std::optional<double> power = {};  // of all lights, W
};

void PrintTo(const OtherScene& scene, std::ostream* out) { *out << scene.name; }

const OtherScene kOtherScenes[] = {
    {"barn-lamp", 10207, 1000, 1000, 44.0, {0.4, 0.08, 1.0}, 280, 0},
    {"cornell-box", 36, 1024, 1024, 19.5, {0, 1, 6.8}, 2, 0, glm::pi<double>() * 0.1786 * (17 + 12 + 4) / 3},
    {"flight-helmet", 94728, 900, 1200, 32.0, {0.35, 0.48, 1.5}, 2, 2},
    {"glass-die", 18436, 1000, 600, 30.68, {0.656, 5.666, 8.073}, 2, 0},
    {"living-room-dense", 789920, 1280, 720, 29.39, {0.277, 1.018, -5.193}, 3968, 0},
    {"modern-hall", 28735, 1024, 1024, 70.0, {6.912, 1.652, 2.554}, 256, 0},
    {"pine-grove", 41252, 1280, 720, 45.0, {60, 55, 175}, 0, 2},
    {"pool", 41564, 1024, 600, 57.62, {0, 1.63, 8}, 0, 2},
    {"psor-prism", 33796, 640, 480, 49.13, {-13.206, 103.171, 67.92}, 2, 0},
    {"veach-ajar", 382628, 1280, 720, 35.98, {4.054, 1.616, -2.307}, 2, 0},
    {"veach-bidir", 11544, 1024, 1024, 35.0, {16.215, 4.052, 0.011}, 4, 0},
    {"water-caustic", 103487, 1024, 1024, 19.5, {0, 0.991, 6.839}, 2, 0},
};

std::filesystem::path fileOf(const OtherScene& scene) {
  return std::filesystem::path(IMPORTON_OTHER_SCENES) / scene.name / (std::string(scene.name) + ".glb");
}

std::vector<OtherScene> scenesThere() {
  std::vector<OtherScene> scenes;
  for (const OtherScene& scene : kOtherScenes)
    if (std::filesystem::exists(fileOf(scene))) scenes.push_back(scene);
  return scenes;
}

class OtherScenes : public testing::TestWithParam<OtherScene> {};

TEST_P(OtherScenes, LoadWithTheirTrianglesCamerasAndLights) {
  const OtherScene& expected = GetParam();
  Log log(Log::Verbosity::quiet);
  const Scene scene = loadGltf(fileOf(expected), log);
  EXPECT_EQ(scene.triangles.size(), expected.triangles);
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].width, expected.width);
  EXPECT_EQ(scene.cameras[0].height, expected.height);
  EXPECT_NEAR(glm::degrees(scene.cameras[0].yfov), expected.yfovDegrees, 0.01);
  EXPECT_LT(glm::length(glm::dvec3(scene.cameras[0].worldFromCamera[3]) - expected.eye), 2e-3);
  EXPECT_EQ(scene.lights.size(), expected.emissiveTriangles + expected.otherLights);
  double power = 0;
  for (const Light& light : scene.lights) {
    EXPECT_GT(light.power, 0);
    power += light.power;
  }
  EXPECT_NEAR(power, expected.power.value_or(power), 0.01);
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(OtherScenes);
INSTANTIATE_TEST_SUITE_P(All, OtherScenes, testing::ValuesIn(scenesThere()), [](const auto& instance) {
  std::string name = instance.param.name;
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace importon::test
