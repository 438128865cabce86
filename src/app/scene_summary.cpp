#include "app/scene_summary.h"

#include <array>
#include <nlohmann/json.hpp>

#include "fmt/format.h"
#include "scene/studio.h"

namespace importon {
namespace {

using Json = nlohmann::ordered_json;

struct LightKind {
  uint kind;
  const char* name;
};
constexpr std::array kLightKinds{LightKind{kLightTriangle, "triangle"}, LightKind{kLightPoint, "point"},
                                 LightKind{kLightSpot, "spot"},         LightKind{kLightDirectional, "directional"},
                                 LightKind{kLightProfile, "profile"},   LightKind{kLightEnvironment, "environment"}};

std::size_t countLights(const Scene& scene, uint kind) {
  std::size_t count = 0;
  for (const Light& light : scene.lights) count += light.kind == kind ? 1 : 0;
  return count;
}

glm::dvec3 inWorld(const Scene& scene, vec3 position) { return glm::dvec3(position) + scene.worldFromRender; }

std::string cameraText(const Camera& camera) {
  std::string text = camera.name.empty() ? "(unnamed)" : camera.name;
  if (camera.isOrthographic) {
    text += fmt::format(", orthographic, {:.4g} x {:.4g} m", 2 * camera.xmag, 2 * camera.ymag);
  } else {
    text += fmt::format(", perspective, {:.1f} degrees high", glm::degrees(camera.yfov));
  }
  if (camera.fStop > 0 && camera.focusDistance > 0)
    text += fmt::format(", f/{:.4g} in focus at {:.4g} m", camera.fStop, camera.focusDistance);
  if (camera.width > 0 && camera.height > 0) text += fmt::format(", {} x {} pixels", camera.width, camera.height);
  return text;
}

std::string choiceText(const char* kind, const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format("{:<10} {}\n", fmt::format("{} {}", kind, i), names[i].empty() ? "(unnamed)" : names[i]);
  return text;
}

/// "walk, 2.5 s, 3 channels: 2 rotation, 1 translation".
std::string animationText(const AnimationSummary& animation) {
  std::string text = animation.name.empty() ? "(unnamed)" : animation.name;
  text += animation.duration ? fmt::format(", {:.6g} s", *animation.duration) : std::string(", of unknown length");
  std::string kinds;
  std::size_t count = 0;
  for (const auto& [kind, channels] : animation.channels) {
    kinds += fmt::format("{} {} {}", count == 0 ? ":" : ",", channels, kind);
    count += channels;
  }
  return text + fmt::format(", {} channel{}{}", count, count == 1 ? "" : "s", kinds);
}

Json animationJson(const AnimationSummary& animation) {
  return {{"name", animation.name},
          {"seconds", animation.duration ? Json(*animation.duration) : Json()},
          {"channels", animation.channels.empty() ? Json::object() : Json(animation.channels)}};
}

Json cameraJson(const Camera& camera) {
  Json json{{"name", camera.name},
            {"node", camera.nodeName},
            {"type", camera.isOrthographic ? "orthographic" : "perspective"}};
  if (camera.isOrthographic) {
    json["xmag"] = camera.xmag;
    json["ymag"] = camera.ymag;
  } else {
    json["yfov"] = camera.yfov;
  }
  if (camera.fStop > 0) json["f_stop"] = camera.fStop;
  if (camera.focusDistance > 0) json["focus_distance"] = camera.focusDistance;
  if (camera.width > 0) json["width"] = camera.width;
  if (camera.height > 0) json["height"] = camera.height;
  return json;
}

std::string featureLines(std::span<const FeatureRow> features, bool isModelled) {
  std::string text;
  for (const FeatureRow& row : features) {
    if (row.isModelled == isModelled) text += fmt::format("  {:<22} {}\n", row.name, row.why);
  }
  return text.empty() ? "  nothing\n" : text;
}

}  // namespace

std::string summaryText(const Scene& scene, std::span<const FeatureRow> features) {
  const glm::dvec3 low = inWorld(scene, scene.boundsMin), high = inWorld(scene, scene.boundsMax);
  std::string text = fmt::format("scene      {}\n", scene.file.string());
  text += fmt::format("triangles  {} ({} vertices)\n", scene.shownTriangleCount(), scene.positions.size());
  if (!scene.placed.isEmpty())
    text += fmt::format("placed     {} instances of {} meshes of {} triangles in all\n", scene.placed.instances.size(),
                        scene.placed.meshes.size(), scene.triangles.size() - scene.worldTriangleCount());
  text += fmt::format("materials  {}, textures {}\n", scene.materials.size(), scene.textures.size());
  text += fmt::format("bounds     {:.6g} {:.6g} {:.6g} to {:.6g} {:.6g} {:.6g} m\n", low.x, low.y, low.z, high.x,
                      high.y, high.z);
  text += fmt::format("lights     {}", scene.lights.size());
  for (const LightKind& light : kLightKinds) {
    const std::size_t count = countLights(scene, light.kind);
    if (count > 0) text += fmt::format(", {} {}", count, light.name);
  }
  if (scene.isInStudio) text += ": the studio, instead of an environment of the scene";
  text += "\n";
  text += choiceText("scene", scene.sceneNames.size() > 1 ? scene.sceneNames : std::vector<std::string>());
  text += choiceText("variant", scene.variantNames);
  for (std::size_t i = 0; i < scene.animations.size(); ++i)
    text += fmt::format("animation {}  {}\n", i, animationText(scene.animations[i]));
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    text += fmt::format("camera {}   {}{}\n", i, cameraText(scene.cameras[i]),
                        scene.hasCameraInFile ? "" : " (none in the file: this one frames the scene)");
  }
  text += "\nmodelled\n" + featureLines(features, true);
  text += "\nleft out\n" + featureLines(features, false);
  return text;
}

std::string summaryJson(const Scene& scene, std::span<const FeatureRow> features) {
  const glm::dvec3 low = inWorld(scene, scene.boundsMin), high = inWorld(scene, scene.boundsMax);
  Json root{{"file", scene.file.string()},
            {"triangles", scene.shownTriangleCount()},
            {"instances", scene.placed.instances.size()},
            {"vertices", scene.positions.size()},
            {"materials", scene.materials.size()},
            {"textures", scene.textures.size()},
            {"bounds", {{"min", {low.x, low.y, low.z}}, {"max", {high.x, high.y, high.z}}}}};
  root["lights"] = Json{{"total", scene.lights.size()}};
  for (const LightKind& light : kLightKinds) root["lights"][light.name] = countLights(scene, light.kind);
  root["light"] = lightName(scene);
  root["scenes"] = scene.sceneNames;
  root["variants"] = scene.variantNames;
  root["animations"] = Json::array();
  for (const AnimationSummary& animation : scene.animations) root["animations"].push_back(animationJson(animation));
  root["cameras"] = Json::array();
  for (const Camera& camera : scene.cameras) root["cameras"].push_back(cameraJson(camera));
  root["has_camera_in_file"] = scene.hasCameraInFile;
  root["features"] = Json::array();
  for (const FeatureRow& row : features) {
    root["features"].push_back({{"name", row.name}, {"modelled", row.isModelled}, {"why", row.why}});
  }
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace importon
