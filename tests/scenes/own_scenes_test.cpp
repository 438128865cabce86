#include <gtest/gtest.h>

#include <filesystem>
#include <glm/gtc/constants.hpp>
#include <span>
#include <string>

#include "base/log.h"
#include "scene/gltf_loader.h"
#include "scene/materials/material_table.h"

namespace importon {
namespace {

/// What scenes/README.md says of a scene.
struct Expectation {
  const char* name;
  std::size_t triangles;
  std::size_t lights;   // emissive triangles
  float lightArea;      // m², all together
  float greenRadiance;  // W/(m² sr)
  int width, height;
  bool isAllDiffuse;
  std::size_t otherLights = 0;  // than quads
};

std::ostream& operator<<(std::ostream& stream, const Expectation& expectation) { return stream << expectation.name; }

class OwnScenes : public ::testing::TestWithParam<Expectation> {
 protected:
  static Scene load(Log& log) {
    const std::string name = GetParam().name;
    return loadGltf(std::filesystem::path(IMPORTON_SCENES_FOLDER) / name / (name + ".gltf"), log);
  }
};

TEST_P(OwnScenes, LoadWithoutAWarning) {
  Log log(Log::Verbosity::quiet);
  const Scene scene = load(log);
  for (const Warning& warning : log.warnings()) ADD_FAILURE() << warning.kind << ": " << warning.message;
  EXPECT_EQ(scene.triangles.size(), GetParam().triangles);
}

TEST_P(OwnScenes, HaveOneCameraWithAnImageSize) {
  Log log(Log::Verbosity::quiet);
  const Scene scene = load(log);
  ASSERT_TRUE(scene.hasCameraInFile);
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].width, GetParam().width);
  EXPECT_EQ(scene.cameras[0].height, GetParam().height);
  const glm::dvec3 position = glm::dvec3(scene.cameras[0].worldFromCamera[3]) - scene.worldFromRender;
  EXPECT_LT(glm::length(position - glm::dvec3(scene.boundsMin + scene.boundsMax) * 0.5),
            2.0 * glm::length(scene.boundsMax - scene.boundsMin));
}

TEST_P(OwnScenes, AreLitByTheQuadsThatTheirReadmeNames) {
  Log log(Log::Verbosity::quiet);
  const Scene scene = load(log);
  ASSERT_EQ(scene.lights.size(), GetParam().lights + GetParam().otherLights);
  float area = 0;
  for (const Light& light : std::span(scene.lights).first(GetParam().lights)) {
    EXPECT_EQ(light.kind, kLightTriangle);
    EXPECT_FLOAT_EQ(light.emission.g, GetParam().greenRadiance);
    area += light.area;
  }
  EXPECT_NEAR(area, GetParam().lightArea, 1e-4f * GetParam().lightArea);
}

TEST_P(OwnScenes, HaveOnlyLambertianAndSmoothSpecularMaterials) {
  Log log(Log::Verbosity::quiet);
  const Scene scene = load(log);
  bool isAllDiffuse = true;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& material = scene.materials[i];
    const bool isLambertian = material.metallic == 0 && material.specular == 0 && material.transmission == 0;
    const bool isMetal = material.metallic == 1;
    const bool isSolidGlass = material.transmission == 1 && (material.flags & kMaterialSolid) != 0;
    const bool isSmooth = isMetal || isSolidGlass || material_table::isPane(material);
    EXPECT_TRUE(isLambertian || (isSmooth && material.roughness == 0)) << scene.materialNames[i];
    EXPECT_EQ(material.flags & kMaterialDoubleSided, 0u) << scene.materialNames[i];
    isAllDiffuse = isAllDiffuse && isLambertian;
  }
  EXPECT_EQ(isAllDiffuse, GetParam().isAllDiffuse);
}

INSTANTIATE_TEST_SUITE_P(All, OwnScenes,
                         ::testing::Values(Expectation{"cornell_box", 36, 2, 0.192f, 16, 512, 512, true},
                                           Expectation{"glass_ball", 40972, 2, 0.16f, 26, 512, 512, false},
                                           Expectation{"glass_caustic", 57658, 2, 0.0025f, 1750, 640, 480, false},
                                           Expectation{"rooms", 96220, 24, 3.0f, 90, 640, 480, true},
                                           Expectation{"door_slit", 24674, 2, 0.09f, 16000, 640, 480, true},
                                           Expectation{"gallery", 5514, 2, 0.25f, 385, 640, 480, true},
                                           Expectation{"ring", 24580, 2, 0.01f, 1220, 640, 480, false},
                                           Expectation{"pool", 34302, 2, 0.09f, 3450, 640, 480, false},
                                           Expectation{"window", 3564, 0, 0.0f, 0, 640, 480, false, 2}),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace importon
