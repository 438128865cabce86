/// How a binary tree becomes one of nodes with up to kBvhWidth children.
#pragma once
#include <array>
#include <cstdint>

#include "accel/binary_tree.h"
#include "base/large_vector.h"
#include "shared/bvh_data.h"

namespace importon {

struct WideTreeOptions {
  std::uint32_t maxLeafPrimitives = 3;
  float nodeCost = 1.0f;          // of a step through a wide node, in units of
  float intersectionCost = 1.0f;  // a primitive's test
  /// Leaves come first among children, then the smaller of the boxes, else they come as in the binary tree. Of
  /// children that a ray enters at the same distance, as it does where it starts, it visits the first one
  /// first.
  bool listsLeavesFirst = false;
};

/// Children of a wide node: nodes of the binary tree, each a leaf or again a wide node.
struct WideChildren {
  std::array<std::uint32_t, kBvhWidth> nodes;
  std::uint32_t count = 0;
};

/// Chooses which nodes of `tree` become wide nodes and which leaves, so that the surface area cost is least, by
/// dynamic programming over (node, slots to fill) [Ylitie et al. 2017, Efficient incoherent ray traversal on
/// GPUs through compressed wide BVHs, section 3.1]. Keeps a reference to the tree. The root, node 0, is always
/// a wide node.
class WideTree {
 public:
  WideTree(const BinaryTree& tree, const WideTreeOptions& options);

  /// Wide nodes on the longest path.
  [[nodiscard]] std::uint32_t depth() const { return depth_; }
  [[nodiscard]] WideChildren children(std::uint32_t node) const;
  [[nodiscard]] bool isLeaf(std::uint32_t node) const { return choices_[node].isLeaf; }
  /// Nodes and primitives below a node, saturated; of a leaf, its primitives but the first.
  [[nodiscard]] std::uint32_t recordsBelow(std::uint32_t node) const { return choices_[node].recordsBelow; }

 private:
  /// What is best for a binary node that may fill s slots of its wide parent.
  struct Choice {
    std::uint32_t recordsBelow;
    std::array<std::uint8_t, kBvhWidth - 1> leftSlots;  // [s - 2], s = 2 … kBvhWidth; 0: fewer slots are better
    bool isLeaf;                                        // in one slot: a leaf, else a wide node
  };
  struct Plan;

  Plan plan(std::uint32_t node);
  Plan planLeaf(std::uint32_t node);
  Plan planInner(std::uint32_t node, const Plan& left, const Plan& right);
  [[nodiscard]] float leafCost(const BinaryNode& node) const;
  [[nodiscard]] bool comesBefore(std::uint32_t a, std::uint32_t b) const;
  void fill(std::uint32_t node, std::uint32_t slots, WideChildren& children) const;

  const BinaryTree& tree_;
  WideTreeOptions options_;
  std::uint32_t depth_ = 0;
  LargeVector<Choice> choices_;  // by binary node, as far as it is used
};

}  // namespace importon
