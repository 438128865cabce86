/// Real scenes by other people, if they lie beside the source folder.
#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

#include "loader/load.h"

namespace importon::test {
namespace {

struct SharedScene {
  const char* name;
  std::size_t triangles;
  int width, height;
  double yfovDegrees;
  glm::dvec3 eye;
  std::size_t emissiveTriangles;
  std::size_t otherLights;
};

void PrintTo(const SharedScene& scene, std::ostream* out) { *out << scene.name; }

const SharedScene kScenes[] = {
    {"barn-lamp", 10207, 1000, 1000, 44.0, {0.4, 0.08, 1.0}, 280, 0},
    {"cornell-box", 36, 1024, 1024, 19.5, {0, 1, 6.8}, 2, 0},
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

class SharedScenes : public testing::TestWithParam<SharedScene> {};

TEST_P(SharedScenes, LoadWithTheirTrianglesCamerasAndLights) {
  const SharedScene& expected = GetParam();
  const std::filesystem::path file =
      std::filesystem::path(IMPORTON_SHARED_SCENES) / expected.name / (std::string(expected.name) + ".glb");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is missing";
  Log log(Log::Verbosity::quiet);
  const Scene scene = loadGltf(file, log);
  EXPECT_EQ(scene.triangles.size(), expected.triangles);
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].width, expected.width);
  EXPECT_EQ(scene.cameras[0].height, expected.height);
  EXPECT_NEAR(glm::degrees(scene.cameras[0].yfov), expected.yfovDegrees, 0.01);
  EXPECT_LT(glm::length(glm::dvec3(scene.cameras[0].worldFromCamera[3]) - expected.eye), 2e-3);
  EXPECT_EQ(scene.lights.size(), expected.emissiveTriangles + expected.otherLights);
  for (const Light& light : scene.lights) EXPECT_GT(light.power, 0);
}

INSTANTIATE_TEST_SUITE_P(All, SharedScenes, testing::ValuesIn(kScenes), [](const auto& instance) {
  std::string name = instance.param.name;
  std::erase(name, '-');
  return name;
});

TEST(SharedScene, TheLightOfTheCornellBoxHasItsKnownPower) {
  const std::filesystem::path file =
      std::filesystem::path(IMPORTON_SHARED_SCENES) / "cornell-box/cornell-box.glb";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is missing";
  Log log(Log::Verbosity::quiet);
  const Scene scene = loadGltf(file, log);
  double power = 0;
  for (const Light& light : scene.lights) power += light.power;
  EXPECT_NEAR(power, glm::pi<double>() * 0.1786 * 11, 0.01);  // pi A L, L = (17 + 12 + 4)/3
}

}  // namespace
}  // namespace importon::test
