/// A binary tree of boxes over primitives, built top-down with binned surface area heuristic.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "accel/box.h"
#include "accel/build_progress.h"
#include "base/large_vector.h"
#include "shared/bvh_data.h"

namespace importon {

/// A primitive's box; its index, in triangles, stands in the bits of lo[3].
using PrimitiveBox = Box;
[[nodiscard]] inline std::uint32_t primitiveIndex(const PrimitiveBox& box) {
  std::uint32_t index;
  const float bits = box.lo[3];
  std::memcpy(&index, &bits, sizeof index);
  return index;
}
inline void setPrimitiveIndex(PrimitiveBox& box, std::uint32_t index) {
  float bits;
  std::memcpy(&bits, &index, sizeof bits);
  box.lo[3] = bits;
}

constexpr std::uint32_t kMaxPrimitives = 0x3FFFFFFFu;

/// Nodes lie in depth-first order with gaps: the left child of node i is i + 1, the right child
/// i + 2·(primitives of the left child). So indices don't depend on the order in which threads build. A few, to
/// which TreeTop has given other children, have links instead.
struct BinaryNode {
  float lo[3];
  std::uint32_t first;  // position of its first primitive in BinaryTree::order; of its links if it has them
  float hi[3];
  std::uint32_t count : 30;  // primitives below
  std::uint32_t hasLinks : 1;
  std::uint32_t isLeaf : 1;

  [[nodiscard]] float halfArea() const {
    const float x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
    return x * y + (x + y) * z;
  }
};
static_assert(sizeof(BinaryNode) == 32);

struct BinaryTree {
  LargeVector<BinaryNode> nodes;     // 2·primitives, of which the gaps are not initialised; the root is node 0
  LargeVector<std::uint32_t> order;  // primitive indices; those of a leaf are contiguous
  std::vector<std::array<std::uint32_t, 2>> links;  // left and right child of nodes that have links
  std::uint32_t coincident = 0;                     // most primitives whose boxes all have the same centre

  [[nodiscard]] std::uint32_t leftChild(std::uint32_t node) const {
    return nodes[node].hasLinks ? links[nodes[node].first][0] : node + 1;
  }
  [[nodiscard]] std::uint32_t rightChild(std::uint32_t node) const {
    return nodes[node].hasLinks ? links[nodes[node].first][1] : node + 2 * nodes[node + 1].count;
  }
};

struct BinaryTreeOptions {
  std::uint32_t maxLeafPrimitives = 4;
  float traversalCost = 1.0f;     // of a step through a binary node, in units of
  float intersectionCost = 1.0f;  // a primitive's test
  /// From this depth on nodes are halved, which takes as many more levels as the count of primitives has bits.
  std::uint32_t sahDepth = kBvhMaxDepth - kBvhIndexBits - 1;
};

/// Builds over `boxes` (at least one). The same tree whatever the number
/// of threads of the calling TBB arena. By default no path is longer than kBvhMaxDepth nodes. [Wald 2007, On fast
/// construction of SAH-based bounding volume hierarchies]
[[nodiscard]] BinaryTree buildBinaryTree(LargeVector<PrimitiveBox> boxes, const BinaryTreeOptions& options,
                                         BuildProgress& progress);

}  // namespace importon
