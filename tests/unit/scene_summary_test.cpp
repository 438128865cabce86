#include "app/scene_summary.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace importon::scene_summary_test {
namespace {

Scene sample() {
  Scene scene;
  scene.file = "room.gltf";
  scene.positions.resize(4);
  scene.triangles.resize(2);
  scene.materials.resize(3);
  scene.lights.resize(3);
  scene.lights[0].kind = scene.lights[1].kind = kLightTriangle;
  scene.lights[2].kind = kLightSpot;
  scene.worldFromRender = {100, 0, 0};
  scene.boundsMin = {-1, -2, -3};
  scene.boundsMax = {1, 2, 3};
  Camera camera;
  camera.name = "front";
  camera.yfov = glm::radians(45.0);
  camera.width = 320;
  camera.height = 200;
  scene.cameras = {camera};
  return scene;
}

const std::vector<FeatureRow> kFeatures{{"mirror", true, "material \"ball\" is a perfect mirror"},
                                        {"glass", false, "no material transmits"}};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(SceneSummary, CountsAndPlacesInTheWorld) {
  const std::string text = summaryText(sample(), kFeatures);
  EXPECT_TRUE(has(text, "triangles  2 (4 vertices)")) << text;
  EXPECT_TRUE(has(text, "lights     3, 2 triangle, 1 spot")) << text;
  EXPECT_TRUE(has(text, "99 -2 -3 to 101 2 3 m")) << text;
  EXPECT_TRUE(has(text, "front, perspective, 45.0 degrees high, 320 x 200 pixels")) << text;
}

TEST(SceneSummary, TellsOfALens) {
  Scene scene = sample();
  scene.cameras[0].fStop = 1.4;
  scene.cameras[0].focusDistance = 2.5;
  const std::string text = summaryText(scene, kFeatures);
  EXPECT_TRUE(has(text, "45.0 degrees high, f/1.4 in focus at 2.5 m, 320 x 200 pixels")) << text;
  const auto json = nlohmann::json::parse(summaryJson(scene, kFeatures));
  EXPECT_EQ(json["cameras"][0]["f_stop"], 1.4);
  EXPECT_EQ(json["cameras"][0]["focus_distance"], 2.5);
}

TEST(SceneSummary, TellsWhatIsModelledAndWhatIsLeftOutAndWhy) {
  const std::string text = summaryText(sample(), kFeatures);
  const std::size_t modelled = text.find("\nmodelled\n"), leftOut = text.find("\nleft out\n");
  ASSERT_NE(modelled, std::string::npos);
  ASSERT_NE(leftOut, std::string::npos);
  const std::size_t mirror = text.find("perfect mirror"), glass = text.find("no material transmits");
  EXPECT_TRUE(modelled < mirror && mirror < leftOut);
  EXPECT_TRUE(leftOut < glass && glass != std::string::npos);
}

TEST(SceneSummary, SaysWhenTheCameraIsNotFromTheFile) {
  Scene scene = sample();
  EXPECT_FALSE(has(summaryText(scene, kFeatures), "frames the scene"));
  scene.hasCameraInFile = false;
  EXPECT_TRUE(has(summaryText(scene, kFeatures), "frames the scene"));
}

TEST(SceneSummary, TellsTheSameAsJson) {
  const auto json = nlohmann::json::parse(summaryJson(sample(), kFeatures));
  EXPECT_EQ(json["file"], "room.gltf");
  EXPECT_EQ(json["triangles"], 2);
  EXPECT_EQ(json["lights"]["total"], 3);
  EXPECT_EQ(json["lights"]["triangle"], 2);
  EXPECT_EQ(json["lights"]["point"], 0);
  EXPECT_EQ(json["bounds"]["max"], (nlohmann::json{101., 2., 3.}));
  EXPECT_EQ(json["cameras"][0]["name"], "front");
  EXPECT_EQ(json["cameras"][0]["width"], 320);
  EXPECT_EQ(json["features"][0]["modelled"], true);
  EXPECT_EQ(json["features"][1]["modelled"], false);
  EXPECT_EQ(json["features"][1]["why"], "no material transmits");
}

TEST(SceneSummary, ListsAnimations) {
  Scene scene = sample();
  scene.animations = {{"walk", 2.5, {{"rotation", 2}, {"translation", 1}}}, {"", std::nullopt, {}}};
  const std::string text = summaryText(scene, kFeatures);
  EXPECT_TRUE(has(text, "animation 0  walk, 2.5 s, 3 channels: 2 rotation, 1 translation\n")) << text;
  EXPECT_TRUE(has(text, "animation 1  (unnamed), of unknown length, 0 channels\n")) << text;
  const auto json = nlohmann::json::parse(summaryJson(scene, kFeatures));
  ASSERT_EQ(json["animations"].size(), 2u);
  EXPECT_EQ(json["animations"][0]["name"], "walk");
  EXPECT_EQ(json["animations"][0]["seconds"], 2.5);
  EXPECT_EQ(json["animations"][0]["channels"], (nlohmann::json{{"rotation", 2}, {"translation", 1}}));
  EXPECT_TRUE(json["animations"][1]["seconds"].is_null());
  EXPECT_EQ(nlohmann::json::parse(summaryJson(sample(), kFeatures))["animations"].size(), 0u);
}

}  // namespace
}  // namespace importon::scene_summary_test
