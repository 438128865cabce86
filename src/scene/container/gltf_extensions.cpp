#include "scene/container/gltf_extensions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace importon {
namespace {

constexpr std::array<std::string_view, 18> kKnownExtensions = {
    "EXT_lights_image_based",  "KHR_lights_environment",  "EXT_meshopt_compression",
    "EXT_texture_avif",        "EXT_texture_webp",        "KHR_draco_mesh_compression",
    "KHR_lights_punctual",     "KHR_materials_clearcoat", "KHR_materials_emissive_strength",
    "KHR_materials_ior",       "KHR_materials_specular",  "KHR_materials_transmission",
    "KHR_materials_unlit",     "KHR_materials_volume",    "KHR_mesh_quantization",
    "KHR_meshopt_compression", "KHR_texture_basisu",      "KHR_texture_transform"};

bool isKnown(std::string_view name) {
  return std::find(kKnownExtensions.begin(), kKnownExtensions.end(), name) != kKnownExtensions.end();
}

}  // namespace

void checkExtensions(const nlohmann::json& document, const GltfSource& source, Log& log) {
  const nlohmann::json none = nlohmann::json::array();
  const nlohmann::json& required = document.contains("extensionsRequired") ? document["extensionsRequired"] : none;
  for (std::size_t i = 0; i < required.size(); ++i) {
    const auto& name = required[i].get_ref<const std::string&>();
    if (isKnown(name)) continue;
    throw SceneError(fmt::format("the file requires the extension {}, which is not supported", printable(name)),
                     source.at(fmt::format("/extensionsRequired/{}", i)), "export the file without it");
  }
  std::string unknown;
  const nlohmann::json& used = document.contains("extensionsUsed") ? document["extensionsUsed"] : none;
  for (const nlohmann::json& entry : used) {
    const auto& name = entry.get_ref<const std::string&>();
    if (!isKnown(name)) unknown += (unknown.empty() ? "" : ", ") + printable(name);
  }
  if (!unknown.empty()) {
    log.warn("unknown extension", fmt::format("{}: passed over, not supported: {}", source.name(), unknown));
  }
}

}  // namespace importon
