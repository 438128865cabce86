#include "scene/nodes/gltf_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "base/error.h"
#include "scene/container/gltf_advice.h"
#include "scene/container/gltf_json.h"

namespace importon {
namespace {

/// Orthonormal axes with the handedness of `worldFromNode`; z is kept, y is made normal to it.
glm::dmat4 withoutScale(const glm::dmat4& worldFromNode, const std::string& where) {
  const glm::dvec3 x(worldFromNode[0]);
  const glm::dvec3 y(worldFromNode[1]);
  const glm::dvec3 z = glm::dvec3(worldFromNode[2]) / glm::length(glm::dvec3(worldFromNode[2]));
  const glm::dvec3 up = y - z * glm::dot(y, z);
  const glm::dvec3 unitUp = up / glm::length(up);
  const glm::dvec3 right = glm::cross(unitUp, z) * (glm::dot(glm::cross(y, z), x) < 0 ? -1.0 : 1.0);
  const glm::dmat4 rigid(glm::dvec4(right, 0), glm::dvec4(unitUp, 0), glm::dvec4(z, 0), worldFromNode[3]);
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (std::isfinite(rigid[column][row])) continue;
      throw SceneError("the transform of the camera is not finite, or has scale 0", where, kExportAgain);
    }
  }
  return rigid;
}

void setLens(const tinygltf::Camera& source, const std::string& where, Camera& camera) {
  if (source.type == "perspective") {
    camera.yfov = source.perspective.yfov;
    camera.aspectRatio = source.perspective.aspectRatio;
    if (camera.yfov > 0 && camera.yfov < glm::pi<double>()) return;
    throw SceneError(fmt::format("yfov {} is not between 0 and pi", camera.yfov), where, kExportAgain);
  }
  camera.isOrthographic = true;
  camera.xmag = std::abs(source.orthographic.xmag);
  camera.ymag = std::abs(source.orthographic.ymag);
  if (camera.xmag > 0 && camera.ymag > 0) return;
  throw SceneError("xmag and ymag of a camera must not be 0", where, kExportAgain);
}

/// A member of `extras` that is a number from `least` on; else 0, with a warning if it is there.
double lensNumber(const nlohmann::json& extras, const char* key, double least, const std::string& pointer,
                  const GltfDocument& document) {
  if (member(extras, key).is_null()) return 0;
  const double value = numberOr(extras, key, 0);
  if (value > 0 && value >= least && std::isfinite(value)) return value;
  document.faults.forgive("lens that is none", pointer, fmt::format("{} is not a number above 0", key),
                          "it is left out");
  return 0;
}

void readLens(const nlohmann::json& extras, const std::string& pointer, const GltfDocument& document, Camera& camera) {
  const double fStop = lensNumber(extras, "fStop", Camera::kLeastFStop, pointer, document);
  const double focus = lensNumber(extras, "focusDistance", 0, pointer, document);
  const auto leaveOut = [&](const std::string& what) {
    document.faults.forgive("lens that is none", pointer, what, "the camera is a pinhole");
  };
  if (fStop > 0 && camera.isOrthographic) return leaveOut("an orthographic camera has no lens");
  if (fStop > 0 && focus > 0 && focus <= camera.focalLength())
    return leaveOut(
        fmt::format("focusDistance {} is not beyond the focal length of {:.6g} m", focus, camera.focalLength()));
  if (fStop > 0 && focus == 0) leaveOut("fStop comes without a focusDistance");
  camera.fStop = fStop;
  if (!camera.isOrthographic) camera.focusDistance = focus;
}

Camera readCamera(const GltfDocument& document, const PlacedNode& placed) {
  constexpr int kLargestImage = 65536;
  const tinygltf::Node& node = document.model.nodes[placed.node];
  const auto index = static_cast<std::size_t>(node.camera);
  const tinygltf::Camera& source = document.model.cameras[index];
  Camera camera;
  camera.name = source.name.empty() ? node.name : source.name;
  camera.nodeName = node.name;
  setLens(source, document.source.at(fmt::format("/cameras/{}", index)), camera);
  camera.worldFromCamera =
      withoutScale(placed.worldFromObject, document.source.at(fmt::format("/nodes/{}", placed.node)));
  const nlohmann::json& extras = member(element(member(document.json, "cameras"), index), "extras");
  const int width = integerOr(extras, "width", 0);
  const int height = integerOr(extras, "height", 0);
  if (width > 0 && height > 0 && width <= kLargestImage && height <= kLargestImage) {
    camera.width = width;
    camera.height = height;
  }
  readLens(extras, fmt::format("/cameras/{}/extras", index), document, camera);
  return camera;
}

}  // namespace

std::vector<Camera> readCameras(const GltfDocument& document, std::span<const PlacedNode> nodes) {
  std::vector<PlacedNode> placed;
  std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(placed),
               [&](const PlacedNode& node) { return document.model.nodes[node.node].camera >= 0; });
  std::stable_sort(placed.begin(), placed.end(), [&](const PlacedNode& a, const PlacedNode& b) {
    return document.model.nodes[a.node].camera < document.model.nodes[b.node].camera;
  });
  std::vector<Camera> cameras;
  for (const PlacedNode& node : placed) cameras.push_back(readCamera(document, node));
  return cameras;
}

}  // namespace importon
