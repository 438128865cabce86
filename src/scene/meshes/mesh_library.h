/// The mesh parts of a scene, each read once for all nodes that show it alike.
#pragma once
#include <deque>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "base/log.h"
#include "scene/instances/keep_meshes.h"
#include "scene/meshes/gltf_mesh.h"
#include "scene/meshes/gltf_skin.h"
#include "scene/nodes/gltf_nodes.h"

namespace importon {

class MeshLibrary {
 public:
  MeshLibrary(const GltfDocument& document, Log& log) : document_(document), log_(log) {}

  /// An instance for each part of each mesh that `nodes` show, its material still 0. Nodes of one mesh and
  /// equal morph weights share parts; a skinned mesh is posed by its joints, in the world; EXT_mesh_gpu_instancing
  /// gives several instances a node; hidden nodes give none. To be called once. Throws SceneError, also when
  /// parts have more than 2^26 triangles or vertices together, or more than kMostPages instances.
  [[nodiscard]] std::vector<MeshInstance> instances(std::span<const PlacedNode> nodes);

  /// All parts that instances refer to.
  [[nodiscard]] std::deque<MeshPart>& parts() { return parts_; }

 private:
  using Variant = std::pair<std::size_t, std::vector<double>>;  // mesh, morph weights
  const std::vector<const MeshPart*>& partsOf(const tinygltf::Node& node);
  void count(const MeshPart& part);
  void addRigid(const MeshPart& part, const PlacedNode& placed, const std::vector<glm::dmat4>& nodeFromInstances);
  void addPosed(const MeshPart& part, const SkinPose& pose);

  const GltfDocument& document_;
  Log& log_;
  std::deque<MeshPart> parts_;
  std::vector<MeshInstance> instances_;
  std::map<Variant, std::vector<const MeshPart*>> variants_;
  std::size_t vertices_ = 0;
  std::size_t triangles_ = 0;
};

}  // namespace importon
