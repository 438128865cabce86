#include "scene/meshes/mesh_library.h"

#include <fmt/format.h>

#include "base/error.h"
#include "scene/meshes/gltf_skin.h"

namespace importon {

const std::vector<const MeshPart*>& MeshLibrary::partsOf(const tinygltf::Node& node) {
  const auto mesh = static_cast<std::size_t>(node.mesh);
  const std::vector<double>& weights = node.weights.empty() ? document_.model.meshes[mesh].weights : node.weights;
  const auto [entry, isNew] = variants_.try_emplace({mesh, weights});
  if (isNew) {
    for (MeshPart& part : readMesh(document_, mesh, weights, log_)) {
      entry->second.push_back(&parts_.emplace_back(std::move(part)));
    }
  }
  return entry->second;
}

void MeshLibrary::count(const std::vector<const MeshPart*>& parts) {
  constexpr std::size_t kMost = std::size_t{1} << 26;
  for (const MeshPart* part : parts) {
    vertices_ += part->positions.size();
    triangles_ += part->triangles.size();
    if (vertices_ <= kMost && triangles_ <= kMost) continue;
    throw SceneError(fmt::format("the scene has more than {} triangles or vertices, instances included", kMost),
                     document_.source.name(), "reduce the scene");
  }
}

std::vector<MeshInstance> MeshLibrary::instances(std::span<const PlacedNode> nodes) {
  std::vector<MeshInstance> instances;
  std::vector<const PlacedNode*> placedNodes(document_.model.nodes.size(), nullptr);
  for (const PlacedNode& placed : nodes) placedNodes[placed.node] = &placed;
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = document_.model.nodes[placed.node];
    if (node.mesh < 0) continue;
    const std::vector<const MeshPart*>& parts = partsOf(node);
    count(parts);
    if (node.skin < 0) {
      for (const MeshPart* part : parts) instances.push_back({part, placed.worldFromObject, 0});
      continue;
    }
    const SkinPose pose = readSkinPose(document_, static_cast<std::size_t>(node.skin), placedNodes);
    log_.warn("skinned mesh", fmt::format("{}: the mesh stands as the joints' own transforms pose it",
                                          document_.source.at(fmt::format("/nodes/{}", placed.node))));
    for (const MeshPart* part : parts) {
      parts_.push_back(posePart(*part, pose, document_.source));
      instances.push_back({&parts_.back(), glm::dmat4(1.0), 0});
    }
  }
  return instances;
}

}  // namespace importon
