/// A tree of nodes with up to kBvhWidth children, made from a binary tree.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "accel/binary_tree.h"
#include "shared/bvh_data.h"

namespace importon {

/// Its children are nodes of the binary tree, each either another wide node or a leaf.
struct WideNode {
  static constexpr std::uint32_t kLeaf = 0xFFFFFFFFu;
  struct Child {
    std::uint32_t binaryNode = 0;
    std::uint32_t wideNode = kLeaf;  // kLeaf: a leaf with all primitives below binaryNode
  };
  std::array<Child, kBvhWidth> children;
  std::uint32_t childCount = 0;
};

struct WideTreeOptions {
  std::uint32_t maxLeafPrimitives = 3;
  float nodeCost = 1.0f;          // of a step through a wide node, in units of
  float intersectionCost = 1.0f;  // a primitive's test
};

/// Chooses which binary nodes to keep so that the surface area cost is least, by dynamic programming over
/// (node, slots to fill) [Ylitie et al. 2017, Efficient incoherent ray traversal on GPUs through compressed
/// wide BVHs, section 3.1]. The root is node 0.
[[nodiscard]] std::vector<WideNode> buildWideTree(const BinaryTree& tree, const WideTreeOptions& options);

}  // namespace importon
