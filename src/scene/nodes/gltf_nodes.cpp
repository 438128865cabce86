#include "scene/nodes/gltf_nodes.h"

#include <fmt/format.h>

#include <glm/gtc/quaternion.hpp>

#include "base/error.h"
#include "scene/container/gltf_advice.h"

namespace importon {
namespace {

std::string nodePointer(std::size_t node, const char* rest = "") { return fmt::format("/nodes/{}{}", node, rest); }

glm::dvec3 vectorOr(const std::vector<double>& values, double otherwise) {
  return values.size() == 3 ? glm::dvec3(values[0], values[1], values[2]) : glm::dvec3(otherwise);
}

glm::dmat4 matrixOf(const std::vector<double>& values, std::size_t node, const GltfSource& source) {
  glm::dmat4 matrix;
  for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = values[static_cast<std::size_t>(i)];
  const bool isAffine = matrix[0].w == 0 && matrix[1].w == 0 && matrix[2].w == 0 && matrix[3].w == 1;
  if (isAffine) return matrix;
  throw SceneError("the last row of the matrix is not 0 0 0 1", source.at(nodePointer(node, "/matrix")), kExportAgain);
}

/// glTF 2.0, section 3.5.3: T R S.
glm::dmat4 parentFromNode(const tinygltf::Node& node, std::size_t index, const GltfSource& source) {
  if (!node.matrix.empty()) return matrixOf(node.matrix, index, source);
  glm::dmat4 result(1.0);
  if (!node.rotation.empty()) {
    const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    const double length = glm::length(rotation);
    if (!(length > 0) || !std::isfinite(length)) {
      throw SceneError("the rotation is not a unit quaternion", source.at(nodePointer(index, "/rotation")),
                       kExportAgain);
    }
    result = glm::mat4_cast(rotation / length);
  }
  const glm::dvec3 scale = vectorOr(node.scale, 1.0);
  for (int axis = 0; axis < 3; ++axis) result[axis] *= scale[axis];
  result[3] = glm::dvec4(vectorOr(node.translation, 0.0), 1.0);
  return result;
}

/// Parent of each node, or kNoParent.
constexpr std::size_t kNoParent = static_cast<std::size_t>(-1);

std::vector<std::size_t> parents(const GltfDocument& document) {
  const std::vector<tinygltf::Node>& nodes = document.model.nodes;
  std::vector<std::size_t> parent(nodes.size(), kNoParent);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::size_t c = 0; c < nodes[i].children.size(); ++c) {
      const auto child = static_cast<std::size_t>(nodes[i].children[c]);
      if (parent[child] != kNoParent || child == i) {
        throw SceneError(fmt::format("node {} has more than one parent, or itself for one", child),
                         document.source.at(fmt::format("/nodes/{}/children/{}", i, c)), kExportAgain);
      }
      parent[child] = i;
    }
  }
  return parent;
}

/// Each node has one parent at most: what no root reaches lies on a cycle or below one.
void checkNoCycle(const GltfDocument& document, const std::vector<std::size_t>& parent) {
  const std::vector<tinygltf::Node>& nodes = document.model.nodes;
  std::vector<std::size_t> reached;
  std::vector<bool> isReached(nodes.size(), false);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (parent[i] == kNoParent) reached.push_back(i);
  }
  while (!reached.empty()) {
    const std::size_t node = reached.back();
    reached.pop_back();
    isReached[node] = true;
    for (const int child : nodes[node].children) reached.push_back(static_cast<std::size_t>(child));
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (isReached[i]) continue;
    throw SceneError("the node lies on a cycle of nodes or below one", document.source.at(nodePointer(i)),
                     kExportAgain);
  }
}

/// Roots of the scene, each once.
std::vector<std::size_t> sceneRoots(const GltfDocument& document, const std::vector<std::size_t>& parent) {
  std::vector<std::size_t> roots;
  const std::size_t scene = defaultScene(document);
  if (scene == kNoScene) {
    for (std::size_t i = 0; i < parent.size(); ++i) {
      if (parent[i] == kNoParent) roots.push_back(i);
    }
    return roots;
  }
  std::vector<bool> isListed(parent.size(), false);
  for (const int entry : document.model.scenes[scene].nodes) {
    const auto node = static_cast<std::size_t>(entry);
    if (parent[node] != kNoParent || isListed[node]) {
      throw SceneError(fmt::format("node {} is not a root, or is listed twice", node),
                       document.source.at(fmt::format("/scenes/{}/nodes", scene)), kExportAgain);
    }
    isListed[node] = true;
    roots.push_back(node);
  }
  return roots;
}

}  // namespace

std::size_t defaultScene(const GltfDocument& document) {
  if (document.model.scenes.empty()) return kNoScene;
  return document.model.defaultScene < 0 ? 0 : static_cast<std::size_t>(document.model.defaultScene);
}

std::vector<PlacedNode> placeNodes(const GltfDocument& document) {
  const std::vector<tinygltf::Node>& nodes = document.model.nodes;
  const std::vector<std::size_t> parent = parents(document);
  checkNoCycle(document, parent);
  const std::vector<std::size_t> roots = sceneRoots(document, parent);
  std::vector<PlacedNode> placed;
  std::vector<PlacedNode> pending;  // `worldFromObject` still the parent's
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) pending.push_back({*root, glm::dmat4(1.0)});
  while (!pending.empty()) {
    PlacedNode next = pending.back();
    pending.pop_back();
    const tinygltf::Node& node = nodes[next.node];
    next.worldFromObject = next.worldFromObject * parentFromNode(node, next.node, document.source);
    placed.push_back(next);
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
      pending.push_back({static_cast<std::size_t>(*child), next.worldFromObject});
    }
  }
  return placed;
}

}  // namespace importon
