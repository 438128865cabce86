/// Cameras that go around.
#include "scene/turntable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "loader/load.h"
#include "scene/framing.h"

namespace importon::test {
namespace {

using glm::dvec3;

Scene sceneOf(const std::vector<glm::vec3>& positions) {
  GltfBuilder builder;
  std::vector<std::uint16_t> indices;
  for (std::uint16_t i = 0; i + 2u < positions.size(); ++i)
    for (const int k : {0, 1, 2}) indices.push_back(static_cast<std::uint16_t>(i + k));
  const int position = builder.addPositions(positions), index = builder.addIndices(indices);
  builder.addMesh({{"attributes", {{"POSITION", position}}}, {"indices", index}});
  Log log(Log::Verbosity::quiet);
  const Bytes bytes = builder.glb();
  return loadGltfFromMemory(asBytes(bytes), "test.glb", {}, log, {.light = LightChoice::studio});
}

/// A long bar that is higher at one end.
Scene bar() { return sceneOf({{3, -1, 6}, {4, -1, 6}, {3, 3, 6}, {3, -1, -6}, {4, -1, -6}, {3, 0, -6}}); }

/// How far from the middle of the image, 1: the edge, the farthest point is seen.
double extent(const Camera& camera, const Scene& scene) {
  const glm::dmat4 cameraFromWorld = glm::inverse(camera.worldFromCamera);
  const double high = std::tan(camera.yfov / 2), wide = high * camera.aspectRatio;
  double most = 0;
  for (const vec3& position : scene.positions) {
    const glm::dvec4 p = cameraFromWorld * glm::dvec4(dvec3(position) + scene.worldFromRender, 1);
    EXPECT_LT(p.z, 0);
    most = std::max({most, std::abs(p.x / (p.z * wide)), std::abs(p.y / (p.z * high))});
  }
  return most;
}

TEST(Turntable, ShowsAllOfTheSceneFromAllAround) {
  for (const double aspect : {2.0, 1.0, 0.5}) {
    const Scene scene = bar();
    const Camera first = roundFramingCamera(scene, aspect);
    double most = 0;
    for (int i = 0; i < 36; ++i)
      most = std::max(most, extent(turnedAround(first, turntableCentre(scene, first), i / 36.0), scene));
    EXPECT_LE(most, 0.9 + 1e-9) << aspect;
    EXPECT_GT(most, 0.8) << aspect << ": it is not farther away than it must be";
  }
}

TEST(Turntable, SeesTheSceneFromWhereTheDefaultCameraStandsFirst) {
  const Scene scene = bar();
  EXPECT_EQ(dvec3(roundFramingCamera(scene, 1).worldFromCamera[2]), dvec3(framingCamera(scene, 1).worldFromCamera[2]));
}

TEST(Turntable, GoesCounterClockwiseFromAboveAndEndsWhereItBegan) {
  Camera camera;
  camera.worldFromCamera[3] = {1, 5, 7, 1};
  const Camera quarter = turnedAround(camera, {1, 0, 2}, 0.25);
  const auto expectNear = [](const glm::dvec4& found, const glm::dvec4& expected) {
    EXPECT_LT(glm::length(found - expected), 1e-12);
  };
  expectNear(quarter.worldFromCamera[3], {6, 5, 2, 1});
  expectNear(quarter.worldFromCamera[2], {1, 0, 0, 0});
  expectNear(quarter.worldFromCamera[0], {0, 0, -1, 0});
  expectNear(quarter.worldFromCamera[1], {0, 1, 0, 0});
  for (const double turns : {0.0, 1.0, 7.0})
    EXPECT_EQ(turnedAround(camera, {0.1, 0.2, 0.3}, turns).worldFromCamera, camera.worldFromCamera);
}

TEST(Turntable, GoesAroundWhatACameraOfTheFileLooksAt) {
  Scene scene = bar();
  scene.hasCameraInFile = true;
  const dvec3 middle = (dvec3(scene.boundsMin) + dvec3(scene.boundsMax)) / 2.0 + scene.worldFromRender;
  Camera camera;
  camera.worldFromCamera[3] = {middle.x + 9, middle.y + 2, middle.z + 20, 1};  // along -z, past all
  EXPECT_LT(glm::length(turntableCentre(scene, camera) - (middle + dvec3(9, 2, 0))), 1e-6);
  camera.worldFromCamera[3] = {middle.x, middle.y, middle.z - 20, 1};  // away from it
  EXPECT_LT(glm::length(turntableCentre(scene, camera) - middle), 1e-6);
}

/// A quad at z = `z` that faces along +z or -z, in a list of triangles.
void addQuad(std::vector<glm::vec3>& positions, std::vector<std::uint16_t>& indices, float z, bool isFront) {
  const auto first = static_cast<std::uint16_t>(positions.size());
  for (const auto& [x, y] : {std::pair(-1.0F, -1.0F), {1.0F, -1.0F}, {1.0F, 1.0F}, {-1.0F, 1.0F}})
    positions.emplace_back(x, y, z);
  for (const int i : isFront ? std::array{0, 1, 2, 0, 2, 3} : std::array{0, 2, 1, 0, 3, 2})
    indices.push_back(static_cast<std::uint16_t>(first + i));
}

TEST(Turntable, GoesAroundTheMiddleOfASolidOrThePointOfASurface) {
  const auto centre = [](std::initializer_list<std::pair<float, bool>> quads, double shift) {
    GltfBuilder builder;
    std::vector<glm::vec3> positions;
    std::vector<std::uint16_t> indices;
    for (const auto& [z, isFront] : quads) addQuad(positions, indices, z, isFront);
    const int position = builder.addPositions(positions), index = builder.addIndices(indices);
    builder.addMesh({{"attributes", {{"POSITION", position}}}, {"indices", index}});
    Log log(Log::Verbosity::quiet);
    const Bytes bytes = builder.glb();
    Scene scene = loadGltfFromMemory(asBytes(bytes), "test.glb", {}, log, {.light = LightChoice::studio});
    scene.hasCameraInFile = true;
    Camera camera;
    camera.worldFromCamera[3] = {shift, shift, 10, 1};
    return turntableCentre(scene, camera).z;
  };
  for (const double shift : {0.0, 0.25}) {  // through the edge of two triangles, too
    EXPECT_NEAR(centre({{2, true}, {-4, true}}, shift), 2, 1e-6) << "the nearer surface";
    EXPECT_NEAR(centre({{2, true}, {-4, false}, {-9, true}}, shift), -1, 1e-6) << "inside of a solid";
    EXPECT_NEAR(centre({{2, false}, {-4, false}}, shift), 2, 1e-6) << "a surface from behind";
    EXPECT_NEAR(centre({{12, true}, {-4, true}}, shift), -4, 1e-6) << "not what is behind the camera";
  }
}

}  // namespace
}  // namespace importon::test
