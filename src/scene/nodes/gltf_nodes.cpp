#include "scene/nodes/gltf_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "base/error.h"
#include "scene/container/gltf_advice.h"
#include "scene/container/gltf_json.h"
#include "scene/nodes/transform.h"

namespace importon {
namespace {

std::string nodePointer(std::size_t node, const char* rest = "") { return fmt::format("/nodes/{}{}", node, rest); }

/// The last row of the matrix may be off 0 0 0 1 by rounding; then all is divided by its last element.
glm::dmat4 affine(const std::vector<double>& values, std::size_t node, const GltfSource& source, const Faults& faults) {
  constexpr double kRounding = 1e-4;
  glm::dmat4 matrix;
  for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = values[static_cast<std::size_t>(i)];
  const glm::dvec4 row(matrix[0].w, matrix[1].w, matrix[2].w, matrix[3].w);
  const glm::dvec4 off = glm::abs(row - glm::dvec4(0, 0, 0, 1));
  const double most = std::max(std::max(off.x, off.y), std::max(off.z, off.w));
  if (most == 0) return matrix;
  const std::string pointer = nodePointer(node, "/matrix");
  const char* what = "the last row of the matrix is not 0 0 0 1";
  if (!(most <= kRounding)) throw SceneError(what, source.at(pointer), kExportAgain);
  faults.forgive("matrix off by rounding", pointer, what, "it is taken for that");
  matrix /= row.w;
  for (int column = 0; column < 4; ++column) matrix[column].w = column == 3 ? 1.0 : 0.0;
  return matrix;
}

glm::dmat4 parentFromNode(const tinygltf::Node& node, std::size_t index, const GltfDocument& document) {
  if (!node.matrix.empty()) return affine(node.matrix, index, document.source, document.faults);
  Transform transform;
  const auto& [t, r, s] = std::tie(node.translation, node.rotation, node.scale);
  if (!t.empty()) transform.translation = {t[0], t[1], t[2]};
  if (!r.empty()) transform.rotation = {r[0], r[1], r[2], r[3]};
  if (!s.empty()) transform.scale = {s[0], s[1], s[2]};
  return matrixOf(transform, document.faults, nodePointer(index, "/rotation"));
}

/// KHR_node_visibility; what lies below a hidden node is hidden with it.
bool isHidden(const GltfDocument& document, std::size_t node) {
  const nlohmann::json& json = element(member(document.json, "nodes"), node);
  return !booleanOr(member(json, "extensions", "KHR_node_visibility"), "visible", true);
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

/// Of each node, whether one above it is listed.
std::vector<bool> belowListed(const GltfDocument& document, const std::vector<std::size_t>& parent,
                              const std::vector<bool>& isListed) {
  std::vector<bool> isBelow(parent.size(), false);
  std::vector<std::size_t> pending;
  for (std::size_t i = 0; i < parent.size(); ++i)
    if (parent[i] == kNoParent) pending.push_back(i);
  while (!pending.empty()) {
    const std::size_t node = pending.back();
    pending.pop_back();
    for (const int entry : document.model.nodes[node].children) {
      const auto child = static_cast<std::size_t>(entry);
      isBelow[child] = isListed[node] || isBelow[node];
      pending.push_back(child);
    }
  }
  return isBelow;
}

/// Where drawing starts, each node once. A scene should list roots alone; any other node that it lists is one too,
/// unless it is drawn below another.
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
    const bool isRepeated = isListed[node];
    if (isRepeated || parent[node] != kNoParent) {
      document.faults.forgive("scene with other nodes than roots", fmt::format("/scenes/{}/nodes", scene),
                              fmt::format("node {} is not a root, or is listed twice", node), "it is drawn once");
    }
    isListed[node] = true;
    if (!isRepeated) roots.push_back(node);
  }
  const std::vector<bool> isBelow = belowListed(document, parent, isListed);
  std::erase_if(roots, [&](std::size_t root) { return isBelow[root]; });
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
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) pending.push_back({*root, glm::dmat4(1.0), false});
  while (!pending.empty()) {
    PlacedNode next = pending.back();
    pending.pop_back();
    const tinygltf::Node& node = nodes[next.node];
    next.worldFromObject = next.worldFromObject * parentFromNode(node, next.node, document);
    next.isHidden = next.isHidden || isHidden(document, next.node);
    placed.push_back(next);
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
      pending.push_back({static_cast<std::size_t>(*child), next.worldFromObject, next.isHidden});
    }
  }
  return placed;
}

}  // namespace importon
