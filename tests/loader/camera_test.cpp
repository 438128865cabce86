#include <gtest/gtest.h>

#include <cmath>

#include "loader/load.h"
#include "scene/lights.h"
#include "scene/nodes/gltf_camera.h"

namespace importon::test {
namespace {

const Json kPerspective = {
    {"name", "main"}, {"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"aspectRatio", 1.5}, {"znear", 0.1}}}};

/// The emissive triangle seen by `camera` from a node.
GltfBuilder seen(const Json& camera, Json node = Json::object()) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  node["camera"] = builder.add("cameras", camera);
  builder.addRoot(node);
  return builder;
}

TEST(Camera, ReadsAPerspective) {
  Json camera = kPerspective;
  camera["extras"] = {{"width", 300}, {"height", 200}};
  const Scene scene = load(seen(camera));
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_TRUE(scene.hasCameraInFile);
  EXPECT_EQ(scene.cameras[0].name, "main");
  EXPECT_FALSE(scene.cameras[0].isOrthographic);
  EXPECT_EQ(scene.cameras[0].yfov, 0.7);
  EXPECT_EQ(scene.cameras[0].aspectRatio, 1.5);
  EXPECT_EQ(scene.cameras[0].width, 300);
  EXPECT_EQ(scene.cameras[0].height, 200);
}

TEST(Camera, ReadsAnOrthographicOne) {
  const Scene scene =
      load(seen({{"type", "orthographic"}, {"orthographic", {{"xmag", -2}, {"ymag", 3}, {"znear", 0}, {"zfar", 9}}}},
                {{"name", "stand"}}));
  EXPECT_TRUE(scene.cameras[0].isOrthographic);
  EXPECT_EQ(scene.cameras[0].xmag, 2);
  EXPECT_EQ(scene.cameras[0].ymag, 3);
  EXPECT_EQ(scene.cameras[0].name, "stand") << "the node's name stands in";
}

TEST(Camera, SizesThatAreNoneAreNotGiven) {
  for (const Json& extras : {Json{{"width", -3}, {"height", 2}}, Json{{"width", "3"}, {"height", 2}},
                             Json{{"width", 3}}, Json{{"width", 4000000000}, {"height", 4000000000}}, Json(7)}) {
    Json camera = kPerspective;
    camera["extras"] = extras;
    EXPECT_EQ(load(seen(camera)).cameras[0].width, 0) << extras;
  }
}

TEST(Camera, ReadsALens) {
  Json camera = kPerspective;
  camera["extras"] = {{"fStop", 1.4}, {"focusDistance", 2}};
  const Camera read = load(seen(camera)).cameras.at(0);
  EXPECT_EQ(read.fStop, 1.4);
  EXPECT_EQ(read.focusDistance, 2);
  EXPECT_NEAR(read.focalLength(), 0.012 / std::tan(0.35), 1e-12);
  camera["extras"] = {{"focusDistance", 2}};
  EXPECT_EQ(load(seen(camera)).cameras.at(0).focusDistance, 2);
  EXPECT_TRUE(warningsOf(seen(camera)).empty());
}

TEST(Camera, LensesThatAreNoneAreLeftOutWithAWarning) {
  const Json orthographic = {{"type", "orthographic"},
                             {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0}, {"zfar", 9}}}};
  for (const Json& extras :
       {Json{{"fStop", 0}, {"focusDistance", 2}}, Json{{"fStop", -1}, {"focusDistance", 2}},
        Json{{"fStop", 1e-9}, {"focusDistance", 2}}, Json{{"fStop", "2.8"}, {"focusDistance", 2}},
        Json{{"fStop", 2}, {"focusDistance", -2}}, Json{{"fStop", 2}, {"focusDistance", 0.001}}, Json{{"fStop", 2}}}) {
    for (Json camera : {kPerspective, orthographic}) {
      camera["extras"] = extras;
      const Camera read = load(seen(camera)).cameras.at(0);
      EXPECT_TRUE(read.fStop == 0 || read.focusDistance == 0) << extras;
      const std::vector<Warning> warnings = warningsOf(seen(camera));
      ASSERT_EQ(warnings.size(), 1u) << extras;
      EXPECT_EQ(warnings[0].kind, "lens that is none");
      EXPECT_NE(errorOf(seen(camera), kStrict), "") << extras;
    }
  }
}

TEST(Camera, LosesItsScaleButNotItsPlaceAndMirror) {
  const Camera camera = load(seen(kPerspective, {{"translation", {1, 2, 3}}, {"scale", {-2, 3, 4}}})).cameras.at(0);
  EXPECT_EQ(camera.worldFromCamera, glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(0, 0, 1, 0),
                                               glm::dvec4(1, 2, 3, 1)));
}

TEST(Camera, StaysInTheWorldWhenTheSceneIsFarAway) {
  GltfBuilder builder = seen(kPerspective, {{"translation", {1e8, 0, 2}}});
  builder.json["nodes"][0]["translation"] = {1e8, 0, 0};
  const Scene scene = load(builder);
  EXPECT_EQ(scene.cameras[0].worldFromCamera[3], glm::dvec4(1e8, 0, 2, 1));
  EXPECT_NE(scene.worldFromRender, glm::dvec3(0.0));
}

TEST(Camera, ComesInTheOrderOfTheFile) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  for (const char* name : {"first", "second"}) {
    Json camera = kPerspective;
    camera["name"] = name;
    builder.add("cameras", camera);
  }
  builder.addRoot({{"camera", 1}});
  builder.addRoot({{"camera", 0}});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_EQ(scene.cameras[0].name, "first");
  EXPECT_EQ(scene.cameras[1].name, "second");
}

TEST(Camera, RefusesWhatCannotSee) {
  const auto refused = [](const Json& camera, const std::string& message) {
    const std::string error = errorOf(seen(camera));
    EXPECT_NE(error.find(message), std::string::npos) << error;
  };
  const auto perspective = [](double yfov) {
    return Json{{"type", "perspective"}, {"perspective", {{"yfov", yfov}, {"znear", 1}}}};
  };
  refused({{"type", "fisheye"}}, "'fisheye' is none of perspective, orthographic (test.glb#/cameras/0/type)");
  refused({{"type", "perspective"}}, "'perspective' is missing (test.glb#/cameras/0)");
  refused({{"type", "perspective"}, {"perspective", {{"znear", 1}}}}, "'yfov' is missing");
  refused(perspective(0), "yfov 0 is not between 0 and pi (test.glb#/cameras/0)");
  refused(perspective(4), "yfov 4 is not between");
  const Json flat = {{"xmag", 0}, {"ymag", 1}, {"zfar", 2}, {"znear", 1}};
  refused({{"type", "orthographic"}, {"orthographic", flat}}, "xmag and ymag");
  EXPECT_NE(errorOf(seen(kPerspective, {{"scale", {1, 0, 1}}})).find("scale 0"), std::string::npos);
}

TEST(FramingCamera, SeesTheWholeSceneWhenTheFileHasNone) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["nodes"][0]["translation"] = {1e8, 5, 0};
  const Scene scene = load(builder);
  EXPECT_FALSE(scene.hasCameraInFile);
  ASSERT_EQ(scene.cameras.size(), 1u);
  const Camera& camera = scene.cameras[0];
  const glm::dmat4 cameraFromWorld = glm::inverse(camera.worldFromCamera);
  for (const vec3& position : scene.positions) {
    const glm::dvec4 world(glm::dvec3(position) + scene.worldFromRender, 1);
    const glm::dvec4 inCamera = cameraFromWorld * world;
    ASSERT_LT(inCamera.z, 0);
    const double tangent = std::tan(camera.yfov / 2);
    EXPECT_LE(std::abs(inCamera.x), -inCamera.z * tangent * camera.aspectRatio);
    EXPECT_LE(std::abs(inCamera.y), -inCamera.z * tangent);
  }
}

}  // namespace
}  // namespace importon::test
