#include "scene/nodes/gltf_profile_light.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "base/error.h"
#include "scene/container/gltf_advice.h"
#include "scene/container/gltf_json.h"
#include "scene/container/gltf_resources.h"
#include "scene/container/gltf_view.h"
#include "scene/light_math.h"
#include "scene/nodes/gltf_light.h"
#include "scene/profiles/light_profile.h"

namespace importon {
namespace {

constexpr const char* kIesExtension = "EXT_lights_ies";

/// The profiles that lights use, by index in the file.
class ProfileTable {
 public:
  ProfileTable(const GltfDocument& document, Scene& scene, Log& log) : document_(document), scene_(scene), log_(log) {}

  struct Entry {
    LightProfile profile;  // without texels
    uint texture = kNone;
  };

  const Entry& at(std::size_t index) {
    const auto [entry, isNew] = entries_.try_emplace(index);
    if (isNew) entry->second = read(index);
    return entry->second;
  }

 private:
  Entry read(std::size_t index) {
    const std::string pointer = fmt::format("/extensions/{}/lights/{}", kIesExtension, index);
    const std::vector<unsigned char> bytes = bytesOf(index, pointer);
    Entry entry{sampleProfile(parseIes(bytes, document_.source.at(pointer))),
                static_cast<uint>(scene_.textures.size())};
    std::vector<uint>& texels = scene_.texels;
    if (texels.size() + entry.profile.texels.size() > kMostTexels)
      throw SceneError(fmt::format("images and profiles have more than {} texels in all", kMostTexels),
                       document_.source.at(pointer), "reduce the images");
    if (!(entry.profile.most > 0)) return entry;
    scene_.textures.push_back(textureOf(entry.profile, static_cast<uint>(texels.size())));
    texels.insert(texels.end(), entry.profile.texels.begin(), entry.profile.texels.end());
    entry.profile.texels.clear();
    return entry;
  }

  std::vector<unsigned char> bytesOf(std::size_t index, const std::string& pointer) {
    const nlohmann::json& json = element(member(document_.json, "extensions", kIesExtension, "lights"), index);
    const int view = integerOr(json, "bufferView", -1);
    if (view >= 0) {
      const auto bytes = viewBytes(document_, static_cast<std::size_t>(view));
      return {bytes.begin(), bytes.end()};
    }
    if (json.contains("uri"))
      return readUri(stringOr(json, "uri", ""), document_.folder, document_.source.at(pointer + "/uri"), log_);
    throw SceneError("the profile has neither 'uri' nor 'bufferView'", document_.source.at(pointer), kExportAgain);
  }

  const GltfDocument& document_;
  Scene& scene_;
  Log& log_;
  std::map<std::size_t, Entry> entries_;
};

/// As frameAround of shaders/lib/sampling.glsl: two axes across n.
std::pair<glm::dvec3, glm::dvec3> axesAcross(const glm::dvec3& n) {
  const double s = n.z >= 0 ? 1 : -1, a = -1 / (s + n.z), b = n.x * n.y * a;
  return {{1 + s * n.x * n.x * a, s * b, -s * n.x}, {b, s + n.y * n.y * a, -n.y}};
}

/// Around its axis.
void turnLamp(const glm::dmat3& worldFromLight, const std::string& where, Light& light) {
  const auto [x, y] = axesAcross(glm::dvec3(light.direction));
  light.area = static_cast<float>(std::atan2(glm::dot(worldFromLight[0], y), glm::dot(worldFromLight[0], x)));
  if (!std::isfinite(light.area)) throw SceneError("the transform of the light is not finite", where, kExportAgain);
  light.isTwoSided = glm::determinant(worldFromLight) < 0 ? 1u : 0u;
}

}  // namespace

void addProfileLights(const GltfDocument& document, std::span<const PlacedNode> nodes, Scene& scene, Log& log) {
  ProfileTable profiles(document, scene, log);
  const nlohmann::json& jsonNodes = member(document.json, "nodes");
  for (const PlacedNode& placed : nodes) {
    const nlohmann::json& use = member(element(jsonNodes, placed.node), "extensions", kIesExtension);
    const int index = integerOr(use, "light", -1);
    if (index < 0 || placed.isHidden) continue;
    const ProfileTable::Entry& entry = profiles.at(static_cast<std::size_t>(index));
    const vec3 factor = vectorOr<3>(use, "color", vec3(1.0f)) * toFloat(numberOr(use, "multiplier", 1.0));
    Light light = lightOf(entry.profile, entry.texture, factor);
    const std::string where = document.source.at(fmt::format("/nodes/{}", placed.node));
    placeLight(placed.worldFromObject, scene.worldFromRender, where, light);
    turnLamp(glm::dmat3(placed.worldFromObject), where, light);
    if (light.power > 0) scene.lights.push_back(light);
  }
}

}  // namespace importon
