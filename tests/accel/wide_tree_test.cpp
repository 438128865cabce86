#include "accel/wide_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "accel/build_tree.h"

namespace importon::test {
namespace {

/// What a walk over all wide nodes finds below one.
struct Found {
  std::uint32_t depth = 0, records = 0, primitives = 0;
  bool isSorted = true;
};

Found walk(const BinaryTree& tree, const WideTree& wide, std::uint32_t node) {
  Found found;
  const WideChildren children = wide.children(node);
  for (std::uint32_t i = 0; i < children.count; ++i) {
    const std::uint32_t child = children.nodes[i];
    if (wide.isLeaf(child)) {
      found.records += tree.nodes[child].count;
      found.primitives += tree.nodes[child].count;
      found.isSorted &= i == 0 || wide.isLeaf(children.nodes[i - 1]);
      continue;
    }
    const Found below = walk(tree, wide, child);
    EXPECT_EQ(wide.recordsBelow(child), below.records);
    found.depth = std::max(found.depth, below.depth);
    found.records += below.records + 1;
    found.primitives += below.primitives;
    found.isSorted &= below.isSorted;
  }
  ++found.depth;
  return found;
}

}  // namespace

TEST(WideTree, KnowsItsDepthAndRecordsAndListsLeavesFirst) {
  for (const std::size_t count : {1u, 2u, 3u, 10u, 20000u}) {
    const BinaryTree tree = buildTree(randomTriangles(count, 0.05f, 41));
    const WideTree wide(tree, {.listsLeavesFirst = true});
    const Found found = walk(tree, wide, 0);
    EXPECT_EQ(found.primitives, count);
    EXPECT_TRUE(found.isSorted);
    if (tree.nodes[0].isLeaf) continue;
    EXPECT_EQ(wide.depth(), found.depth);
    EXPECT_EQ(wide.recordsBelow(0), found.records);
  }
}

}  // namespace importon::test
