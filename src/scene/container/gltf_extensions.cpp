#include "scene/container/gltf_extensions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace importon {
namespace {

constexpr std::array<std::string_view, 30> kModelled = {"EXT_lights_ies",
                                                        "EXT_lights_image_based",
                                                        "EXT_mesh_gpu_instancing",
                                                        "EXT_meshopt_compression",
                                                        "EXT_texture_avif",
                                                        "EXT_texture_webp",
                                                        "KHR_animation_pointer",
                                                        "KHR_draco_mesh_compression",
                                                        "KHR_lights_environment",
                                                        "KHR_lights_punctual",
                                                        "KHR_materials_anisotropy",
                                                        "KHR_materials_clearcoat",
                                                        "KHR_materials_diffuse_transmission",
                                                        "KHR_materials_dispersion",
                                                        "KHR_materials_emissive_strength",
                                                        "KHR_materials_ior",
                                                        "KHR_materials_iridescence",
                                                        "KHR_materials_pbrSpecularGlossiness",
                                                        "KHR_materials_sheen",
                                                        "KHR_materials_specular",
                                                        "KHR_materials_transmission",
                                                        "KHR_materials_unlit",
                                                        "KHR_materials_variants",
                                                        "KHR_materials_volume",
                                                        "KHR_mesh_quantization",
                                                        "KHR_meshopt_compression",
                                                        "KHR_node_visibility",
                                                        "KHR_techniques_webgl",
                                                        "KHR_texture_basisu",
                                                        "KHR_texture_transform"};

/// Extensions that do not alter the picture of a scene at rest, by what they are about. A '*' at the end stands for
/// anything.
struct Harmless {
  std::string_view name, about;
};
constexpr std::array kHarmless{Harmless{"AGI_articulations", "animation"},
                               Harmless{"AGI_stk_metadata", "metadata"},
                               Harmless{"CESIUM_primitive_outline", "drawn edges"},
                               Harmless{"CESIUM_RTC", "a place of the whole scene on the globe"},
                               Harmless{"EXT_feature_metadata", "metadata"},
                               Harmless{"EXT_instance_features", "metadata"},
                               Harmless{"EXT_mesh_features", "metadata"},
                               Harmless{"EXT_mesh_manifold", "topology"},
                               Harmless{"EXT_structural_metadata", "metadata"},
                               Harmless{"FB_geometry_metadata", "metadata"},
                               Harmless{"FB_ngon_encoding", "polygons that triangles came from"},
                               Harmless{"GODOT_single_root", "the node hierarchy of an engine"},
                               Harmless{"KHR_audio*", "sound"},
                               Harmless{"KHR_collision_shapes", "physics"},
                               Harmless{"KHR_implicit_shapes", "physics"},
                               Harmless{"KHR_interactivity", "interaction"},
                               Harmless{"KHR_node_hoverability", "interaction"},
                               Harmless{"KHR_node_selectability", "interaction"},
                               Harmless{"KHR_physics_rigid_bodies", "physics"},
                               Harmless{"KHR_rigid_bodies", "physics"},
                               Harmless{"KHR_xmp*", "metadata"},
                               Harmless{"MSFT_audio_emitter", "sound"},
                               Harmless{"MSFT_lod", "coarser levels of detail; the finest is drawn"},
                               Harmless{"MSFT_packing_*", "textures packed a second time"},
                               Harmless{"OMI_*", "sound, physics and places to sit"},
                               Harmless{"VRM*", "avatars that move"}};

template <class Names>
bool contains(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// What a harmless extension is about; empty: it is not known as one.
std::string_view aboutHarmless(std::string_view name) {
  for (const Harmless& row : kHarmless) {
    const bool isFamily = row.name.ends_with('*');
    const std::string_view stem = row.name.substr(0, row.name.size() - (isFamily ? 1 : 0));
    if (isFamily ? name.starts_with(stem) : name == stem) return row.about;
  }
  return {};
}

void checkRequired(const std::string& name, const std::string& pointer, const GltfSource& source,
                   const Faults& faults) {
  if (contains(kModelled, name)) return;
  const std::string what = fmt::format("the file requires the extension {}, which is not supported", printable(name));
  const std::string_view about = aboutHarmless(name);
  if (about.empty()) throw SceneError(what, source.at(pointer), "export the file without it");
  faults.forgive("required without need", pointer, what, fmt::format("it is passed over: {}", about));
}

}  // namespace

void checkExtensions(const nlohmann::json& document, const GltfSource& source, const Faults& faults, Log& log) {
  const nlohmann::json none = nlohmann::json::array();
  const nlohmann::json& used = document.contains("extensionsUsed") ? document["extensionsUsed"] : none;
  const nlohmann::json& required = document.contains("extensionsRequired") ? document["extensionsRequired"] : none;
  for (std::size_t i = 0; i < required.size(); ++i) {
    const std::string pointer = fmt::format("/extensionsRequired/{}", i);
    const auto& name = required[i].get_ref<const std::string&>();
    checkRequired(name, pointer, source, faults);
    if (contains(used, name)) continue;
    faults.forgive("extension not declared", pointer,
                   fmt::format("the extension {} is required but not among extensionsUsed", printable(name)),
                   "it is taken for used");
  }
  std::string unknown;
  for (const nlohmann::json& entry : used) {
    const auto& name = entry.get_ref<const std::string&>();
    const std::string_view about = aboutHarmless(name);
    if (!about.empty()) {
      log.detail(fmt::format("{}: {} is passed over: {}", source.name(), printable(name), about));
    } else if (!contains(kModelled, name)) {
      unknown += (unknown.empty() ? "" : ", ") + printable(name);
    }
  }
  if (!unknown.empty()) {
    log.warn("unknown extension", fmt::format("{}: passed over, not supported: {}", source.name(), unknown));
  }
}

}  // namespace importon
