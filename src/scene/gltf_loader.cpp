#include "scene/gltf_loader.h"

#include <fmt/format.h>

#include "base/error.h"
#include "scene/animation/gltf_animation.h"
#include "scene/container/gltf_choices.h"
#include "scene/container/gltf_document.h"
#include "scene/container/gltf_resources.h"
#include "scene/environment.h"
#include "scene/framing.h"
#include "scene/geometry.h"
#include "scene/images/gltf_image.h"
#include "scene/lights.h"
#include "scene/materials/gltf_material.h"
#include "scene/materials/sheets.h"
#include "scene/materials/specular_glossiness.h"
#include "scene/meshes/draco_mesh.h"
#include "scene/meshes/mesh_library.h"
#include "scene/meshes/tangents.h"
#include "scene/nodes/gltf_camera.h"
#include "scene/nodes/gltf_image_light.h"
#include "scene/nodes/gltf_light.h"
#include "scene/nodes/gltf_nodes.h"
#include "scene/nodes/gltf_profile_light.h"
#include "scene/studio.h"

namespace importon {
namespace {

MaterialSet readUsedMaterials(const GltfDocument& document, std::span<const MeshInstance> instances, Log& log) {
  std::vector<bool> isUsed(document.model.materials.size(), false);
  bool needsDefault = false;
  for (const MeshInstance& instance : instances) {
    if (instance.part->material < 0) {
      needsDefault = true;
    } else {
      isUsed[static_cast<std::size_t>(instance.part->material)] = true;
    }
  }
  MaterialSet set = readMaterials(document, isUsed, log);
  if (needsDefault) {
    set.materials.push_back(defaultMaterial());
    set.names.emplace_back("default");
  }
  return set;
}

uint sceneMaterial(const MaterialSet& set, const MeshPart& part) {
  if (part.material < 0) return static_cast<uint>(set.materials.size() - 1);
  return set.materialOfFile[static_cast<std::size_t>(part.material)];
}

/// The texture along which a material's tangents run: of its normals first, as for all that follow them; else that of
/// its anisotropy, or plain coordinates. Null: it needs none.
const Texture* tangentTexture(const Material& material, const std::vector<Texture>& textures) {
  static const Texture kPlain = [] {
    Texture plain{};
    plain.uvRow0 = vec3(1, 0, 0);
    plain.uvRow1 = vec3(0, 1, 0);
    return plain;
  }();
  for (const uint texture : {material.normalTexture, material.clearcoatNormalTexture, material.anisotropyTexture})
    if (texture != kNone) return &textures[texture];
  return material.anisotropy != 0 ? &kPlain : nullptr;
}

/// Normal maps and anisotropy need tangents; computes those that the file lacks. Warns of textures without coordinates.
void completeAttributes(MeshLibrary& library, const MaterialSet& set, const std::string& name, Log& log) {
  for (MeshPart& part : library.parts()) {
    const Material& material = set.materials[sceneMaterial(set, part)];
    const unsigned missing = (part.uv0.empty() ? 1u : 0u) | (part.uv1.empty() ? 2u : 0u);
    if ((uvSetsOf(material, set.textures) & missing) != 0) {
      log.warn("texture without coordinates",
               fmt::format("{}: a mesh lacks the texture coordinates that its material reads; (0, 0) stands in", name));
    }
    const Texture* texture = tangentTexture(material, set.textures);
    if (part.normals.empty()) part.tangents.clear();  // glTF 2.0, section 3.7.2.1: flat normals, tangents ignored
    if (part.tangents.empty() && texture != nullptr) computeTangents(part, *texture);
  }
}

std::optional<EnvironmentMap> chooseEnvironment(const GltfDocument& document, const LoadOptions& options, Log& log) {
  if (options.light == LightChoice::studio) return std::nullopt;
  if (options.environment) return options.environment;
  std::optional<EnvironmentMap> own = readImageLight(document, log);
  return own ? own : readEnvironment(document, log);
}

void setEnvironment(Scene& scene, const EnvironmentMap& map, const LoadOptions& options) {
  scene.environment = options.environmentRotation == 0 ? map : turned(map, options.environmentRotation);
  addEnvironmentLight(scene);
}

void addLights(const GltfDocument& document, std::span<const PlacedNode> nodes, const LoadOptions& options,
               Scene& scene, Log& log) {
  addEmissiveTriangles(scene);
  const float radius = boundingSphere(scene).radius;
  for (const Light& light : readPunctualLights(document, nodes, scene.worldFromRender, radius)) {
    scene.lights.push_back(light);
  }
  addProfileLights(document, nodes, scene, log);
  if (const auto own = chooseEnvironment(document, options, log)) setEnvironment(scene, *own, options);
  scene.isInStudio = options.light == LightChoice::studio ||
                     (options.light == LightChoice::automatic && (isAsGoodAsUnlit(scene) || isGlowingModel(scene)));
  if (scene.isInStudio) setEnvironment(scene, studioEnvironment(), options);
  if (!scene.lights.empty()) return;
  throw SceneError("the scene has no light", document.source.name(),
                   "leave out --light scene, use --environment, or give the scene a light");
}

void addCameras(const GltfDocument& document, std::span<const PlacedNode> nodes, double aspect, Scene& scene) {
  scene.cameras = readCameras(document, nodes);
  scene.hasCameraInFile = !scene.cameras.empty();
  if (!scene.hasCameraInFile) scene.cameras.push_back(framingCamera(scene, aspect));
}

}  // namespace

Scene loadGltf(const std::filesystem::path& file, Log& log, const LoadOptions& options) {
  std::error_code error;
  const std::string name = printable(file.string(), 4096);
  if (!std::filesystem::exists(file, error)) {
    throw SceneError("the file does not exist", name, "check the path");
  }
  if (!std::filesystem::is_regular_file(file, error)) {
    throw SceneError("this is not a file", name, "name a .gltf or .glb file");
  }
  const std::vector<unsigned char> bytes = readWholeFile(file, name);
  const AssetFolder folder{file.has_parent_path() ? file.parent_path() : std::filesystem::path("."), options.outside};
  return loadGltfFromMemory(std::as_bytes(std::span(bytes)), file, folder, log, options);
}

Scene loadGltfFromMemory(std::span<const std::byte> bytes, const std::filesystem::path& name, const AssetFolder& folder,
                         Log& log, const LoadOptions& options) {
  GltfDocument document = readDocument(bytes, name, folder, log, options.file);
  std::vector<AnimationSummary> animations;
  if (options.listsAnimations) animations = describeAnimations(document, log);
  poseDocument(document, options.file, log);
  decodeDracoMeshes(document, log);
  const std::vector<PlacedNode> nodes = placeNodes(document);
  MeshLibrary library(document, log);
  std::vector<MeshInstance> instances = library.instances(nodes);
  MaterialSet set = readUsedMaterials(document, instances, log);
  for (MeshInstance& instance : instances) {
    instance.material = sceneMaterial(set, *instance.part);
    instance.emits = (set.materials[instance.material].flags & kMaterialEmissive) != 0;
  }
  completeAttributes(library, set, document.source.name(), log);
  useSheets(instances, set);

  Scene scene;
  scene.file = name;
  assembleGeometry(instances, scene, document.source.name(), log, options.keep);
  scene.texels = loadTexels(document, set, log);
  makeRoughnessTextures(set, scene.texels, document.source.name());
  scene.textures = std::move(set.textures);
  scene.materials = std::move(set.materials);
  scene.materialNames = std::move(set.names);
  scene.sceneNames = sceneNames(document.json);
  scene.variantNames = variantNames(document.json);
  scene.animations = std::move(animations);
  addCameras(document, nodes, options.frameAspect, scene);
  addLights(document, nodes, options, scene, log);
  return scene;
}

}  // namespace importon
