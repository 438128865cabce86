#include "scene/meshes/mesh_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "scene/materials/gltf_material.h"
#include "scene/meshes/open_surfaces.h"
#include "scene/nodes/gltf_instancing.h"

namespace importon {

const std::vector<const MeshPart*>& MeshLibrary::partsOf(const tinygltf::Node& node) {
  const auto mesh = static_cast<std::size_t>(node.mesh);
  const std::vector<double>& weights = node.weights.empty() ? document_.model.meshes[mesh].weights : node.weights;
  const auto [entry, isNew] = variants_.try_emplace({mesh, weights});
  if (isNew) {
    std::vector<MeshPart> parts = readMesh(document_, mesh, weights, log_);
    std::vector<bool> hasVolume;
    for (const MeshPart& part : parts) hasVolume.push_back(boundsVolume(document_, part.material));
    splitOpenSurfaces(parts, hasVolume);
    for (MeshPart& part : parts) {
      count(part);
      entry->second.push_back(&parts_.emplace_back(std::move(part)));
    }
  }
  return entry->second;
}

/// Of what is held; instances are counted where they are flattened.
void MeshLibrary::count(const MeshPart& part) {
  constexpr std::size_t kMost = std::size_t{1} << 26;
  vertices_ += part.positions.size();
  triangles_ += part.triangles.size();
  if (vertices_ <= kMost && triangles_ <= kMost) return;
  throw SceneError(fmt::format("the scene has more than {} triangles or vertices", kMost), document_.source.name(),
                   "reduce the scene");
}

void MeshLibrary::addRigid(const MeshPart& part, const PlacedNode& placed,
                           const std::vector<glm::dmat4>& nodeFromInstances) {
  if (nodeFromInstances.size() > kMostPages - std::min<std::size_t>(instances_.size(), kMostPages))
    throw SceneError(fmt::format("the scene has more than {} instances of parts of meshes", kMostPages),
                     document_.source.name(), "reduce the scene");
  for (const glm::dmat4& nodeFromInstance : nodeFromInstances) {
    instances_.push_back({&part, placed.worldFromObject * nodeFromInstance});
  }
}

void MeshLibrary::addPosed(const MeshPart& part, const SkinPose& pose) {
  count(part);
  parts_.push_back(posePart(part, pose, document_.source));
  instances_.push_back({&parts_.back(), glm::dmat4(1.0)});
}

std::vector<MeshInstance> MeshLibrary::instances(std::span<const PlacedNode> nodes) {
  std::vector<const PlacedNode*> placedNodes(document_.model.nodes.size(), nullptr);
  for (const PlacedNode& placed : nodes) placedNodes[placed.node] = &placed;
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = document_.model.nodes[placed.node];
    if (node.mesh < 0 || placed.isHidden) continue;
    const std::string pointer = fmt::format("/nodes/{}", placed.node);
    const std::vector<glm::dmat4> nodeFromInstances = readInstances(document_, placed.node);
    std::optional<SkinPose> pose;
    if (node.skin >= 0) {
      pose = readSkinPose(document_, static_cast<std::size_t>(node.skin), placedNodes);
      if (!document_.isPosed)
        log_.warn("skinned mesh", fmt::format("{}: the mesh stands as the joints' own transforms pose it",
                                              document_.source.at(pointer)));
    }
    for (const MeshPart* part : partsOf(node)) {
      if (pose && !part->jointSets.empty()) {
        addPosed(*part, *pose);
        continue;
      }
      if (pose) {
        document_.faults.forgive("skinned mesh without joints", pointer, "a skinned mesh has no JOINTS_0 or WEIGHTS_0",
                                 "it stands where its node does");
      }
      addRigid(*part, placed, nodeFromInstances);
    }
  }
  return std::move(instances_);
}

}  // namespace importon
