// The camera of scenes that bring none.
#include "scene/framing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "loader/load.h"

namespace importon::test {
namespace {

Scene sceneOf(const std::vector<glm::vec3>& positions, const std::vector<std::uint16_t>& indices) {
  GltfBuilder builder;
  const int position = builder.addPositions(positions), index = builder.addIndices(indices);
  builder.addMesh({{"attributes", {{"POSITION", position}}}, {"indices", index}});
  Log log(Log::Verbosity::quiet);
  const Bytes bytes = builder.glb();
  return loadGltfFromMemory(asBytes(bytes), "test.glb", {}, log, {.light = LightChoice::studio});
}

Scene boxAround(const glm::vec3& centre, const glm::vec3& half) {
  std::vector<glm::vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(centre + half * glm::vec3((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1));
  return sceneOf(corners, {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 4, 2, 2, 4, 6,
                           1, 3, 5, 3, 7, 5, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7});
}

Scene quadFacing(const glm::vec3& normal) {
  const glm::vec3 u = glm::normalize(
                      glm::cross(std::abs(normal.y) > 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0), normal)),
                  v = glm::cross(normal, u);
  return sceneOf({-u - v, u - v, u + v, -u + v}, {0, 1, 2, 0, 2, 3});
}

/// Half the extent of the scene in the image, 1: it touches the edge; and whether all lies before the camera.
struct Shown {
  double across = 0, along = 0;
  bool isBefore = true;
};

Shown shownBy(const Camera& camera, const Scene& scene) {
  const glm::dmat4 cameraFromWorld = glm::inverse(camera.worldFromCamera);
  const double high = std::tan(camera.yfov / 2), wide = high * camera.aspectRatio;
  Shown shown;
  for (const vec3& position : scene.positions) {
    const glm::dvec4 p = cameraFromWorld * glm::dvec4(glm::dvec3(position) + scene.worldFromRender, 1);
    shown.isBefore = shown.isBefore && p.z < 0;
    shown.across = std::max(shown.across, std::abs(p.x / (p.z * wide)));
    shown.along = std::max(shown.along, std::abs(p.y / (p.z * high)));
  }
  return shown;
}

glm::dvec3 towardsCamera(const Scene& scene) { return glm::dvec3(scene.cameras[0].worldFromCamera[2]); }

TEST(FramingCamera, FitsWithAMarginOfATenth) {
  for (const glm::vec3& half : {glm::vec3(1), {3, 0.3f, 0.5f}, {0.2f, 4, 0.2f}, {1, 1, 20}}) {
    for (const double aspect : {4.0 / 3, 16.0 / 9, 1.0, 0.5}) {
      const Scene scene = boxAround({5, -3, 2}, half);
      const Shown shown = shownBy(framingCamera(scene, aspect), scene);
      EXPECT_TRUE(shown.isBefore);
      EXPECT_NEAR(std::max(shown.across, shown.along), 0.9, 1e-3) << half.x << " " << half.y << " " << aspect;
    }
  }
}

TEST(FramingCamera, WorksFromAMillimetreToAHundredKilometres) {
  for (const float size : {1e-3f, 1.0f, 1e5f}) {
    const Scene scene = boxAround({0, size, 0}, glm::vec3(size));
    const Shown shown = shownBy(scene.cameras[0], scene);
    EXPECT_TRUE(shown.isBefore) << size;
    EXPECT_NEAR(std::max(shown.across, shown.along), 0.9, 1e-3) << size;
  }
}

TEST(FramingCamera, IsAThreeQuarterView) {
  const glm::dvec3 view = towardsCamera(boxAround({0, 0, 0}, {1, 1, 1}));
  EXPECT_NEAR(glm::degrees(std::atan2(view.x, view.z)), 32, 1e-3);
  EXPECT_NEAR(glm::degrees(std::asin(view.y)), 17, 1e-3);
}

TEST(FramingCamera, SeesFlatThingsFromTheSideThatTheyFace) {
  for (const glm::vec3& normal : {glm::vec3(0, 0, 1), {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}) {
    const Scene scene = quadFacing(normal);
    EXPECT_GT(glm::dot(towardsCamera(scene), glm::dvec3(normal)), 0.35)
        << normal.x << " " << normal.y << " " << normal.z;
  }
  EXPECT_GT(towardsCamera(boxAround({0, 0, 0}, {1, 1e-3f, 1})).y, 0.35) << "a slab on the ground";
}

}  // namespace
}  // namespace importon::test
