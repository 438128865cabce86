#include "scene/gltf_loader.h"

#include <fmt/format.h>

#include <deque>
#include <map>

#include "base/error.h"
#include "scene/geometry.h"
#include "scene/gltf_camera.h"
#include "scene/gltf_document.h"
#include "scene/gltf_image.h"
#include "scene/gltf_light.h"
#include "scene/gltf_material.h"
#include "scene/gltf_mesh.h"
#include "scene/gltf_nodes.h"
#include "scene/gltf_resources.h"
#include "scene/lights.h"
#include "scene/tangents.h"

namespace importon {
namespace {

/// Mesh parts, read once for all nodes that show a mesh with the same morph weights.
class MeshLibrary {
 public:
  MeshLibrary(const GltfDocument& document, Log& log) : document_(document), log_(log) {}

  std::vector<MeshPart>& partsOf(std::size_t nodeIndex) {
    const tinygltf::Node& node = document_.model.nodes[nodeIndex];
    const auto mesh = static_cast<std::size_t>(node.mesh);
    const std::vector<double>& weights =
        node.weights.empty() ? document_.model.meshes[mesh].weights : node.weights;
    const auto [entry, isNew] = parts_.try_emplace({mesh, weights});
    if (isNew) entry->second = readMesh(document_, mesh, weights, log_);
    return entry->second;
  }

  auto begin() { return parts_.begin(); }
  auto end() { return parts_.end(); }

 private:
  const GltfDocument& document_;
  Log& log_;
  std::map<std::pair<std::size_t, std::vector<double>>, std::vector<MeshPart>> parts_;
};

std::vector<MeshInstance> readInstances(const GltfDocument& document, std::span<const PlacedNode> nodes,
                                        MeshLibrary& library, Log& log) {
  std::vector<MeshInstance> instances;
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = document.model.nodes[placed.node];
    if (node.mesh < 0) continue;
    if (node.skin >= 0) {
      log.warn("skinned mesh", fmt::format("{}: skins are passed over, the mesh keeps its rest pose",
                                           document.source.at(fmt::format("/nodes/{}", placed.node))));
    }
    for (const MeshPart& part : library.partsOf(placed.node))
      instances.push_back({&part, placed.worldFromObject, 0});
  }
  return instances;
}

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

/// Normal maps need tangents; computes those that the file lacks.
void completeTangents(MeshLibrary& library, const MaterialSet& set) {
  for (auto& [key, parts] : library) {
    for (MeshPart& part : parts) {
      const uint normalTexture = set.materials[sceneMaterial(set, part)].normalTexture;
      if (part.tangents.empty() && normalTexture != kNone) computeTangents(part, set.textures[normalTexture]);
    }
  }
}

void addLights(const GltfDocument& document, std::span<const PlacedNode> nodes, Scene& scene, Log& log) {
  addEmissiveTriangles(scene);
  const float radius = boundingSphere(scene).radius;
  for (const Light& light : readPunctualLights(document, nodes, scene.worldFromRender, radius)) {
    scene.lights.push_back(light);
  }
  scene.environmentRadiance = readEnvironment(document, log);
  addEnvironmentLight(scene);
  if (!scene.lights.empty()) return;
  throw SceneError(
      "the scene has no light", document.source.name(),
      "give a material emissiveFactor, or add KHR_lights_punctual or extras.environment to the scene");
}

void addCameras(const GltfDocument& document, std::span<const PlacedNode> nodes, Scene& scene) {
  scene.cameras = readCameras(document, nodes);
  scene.hasCameraInFile = !scene.cameras.empty();
  if (scene.hasCameraInFile) return;
  const BoundingSphere sphere = boundingSphere(scene);
  scene.cameras.push_back(framingCamera(glm::dvec3(sphere.centre) + scene.worldFromRender, sphere.radius));
}

}  // namespace

Scene loadGltf(const std::filesystem::path& file, Log& log) {
  std::error_code error;
  const std::string name = printable(file.string(), 4096);
  if (!std::filesystem::exists(file, error)) {
    throw SceneError("the file does not exist", name, "check the path");
  }
  if (!std::filesystem::is_regular_file(file, error)) {
    throw SceneError("this is not a file", name, "name a .gltf or .glb file");
  }
  const std::vector<unsigned char> bytes = readWholeFile(file, name);
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  return loadGltfFromMemory(std::as_bytes(std::span(bytes)), file, folder, log);
}

Scene loadGltfFromMemory(std::span<const std::byte> bytes, const std::filesystem::path& name,
                         const std::filesystem::path& baseFolder, Log& log) {
  const GltfDocument document = readDocument(bytes, name, baseFolder, log);
  const std::vector<PlacedNode> nodes = placeNodes(document);
  MeshLibrary library(document, log);
  std::vector<MeshInstance> instances = readInstances(document, nodes, library, log);
  MaterialSet set = readUsedMaterials(document, instances, log);
  for (MeshInstance& instance : instances) instance.material = sceneMaterial(set, *instance.part);
  completeTangents(library, set);

  Scene scene;
  scene.file = name;
  assembleGeometry(instances, scene, document.source.name(), log);
  scene.texels = loadTexels(document, set);
  scene.textures = std::move(set.textures);
  scene.materials = std::move(set.materials);
  scene.materialNames = std::move(set.names);
  addLights(document, nodes, scene, log);
  addCameras(document, nodes, scene);
  return scene;
}

}  // namespace importon
