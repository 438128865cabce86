#include "accel/tree_top.h"

#include <gtest/gtest.h>

#include <cstring>

#include "accel/build_tree.h"

namespace importon::test {
namespace {

/// What lies below a node.
struct Below {
  double area = 0;  // of the boxes of all inner nodes
  std::vector<std::uint32_t> primitives;
  std::size_t uncovered = 0;  // children that stick out
};

void look(const BinaryTree& tree, std::uint32_t index, Below& below) {
  const BinaryNode& node = tree.nodes[index];
  if (node.isLeaf) {
    for (std::uint32_t i = 0; i < node.count; ++i) below.primitives.push_back(tree.order[node.first + i]);
    return;
  }
  below.area += static_cast<double>(node.halfArea());
  const std::size_t before = below.primitives.size();
  for (const std::uint32_t child : {tree.leftChild(index), tree.rightChild(index)}) {
    for (int axis = 0; axis < 3; ++axis)
      if (tree.nodes[child].lo[axis] < node.lo[axis] || tree.nodes[child].hi[axis] > node.hi[axis]) ++below.uncovered;
    look(tree, child, below);
  }
  EXPECT_EQ(below.primitives.size() - before, node.count);
}

Below look(const BinaryTree& tree) {
  Below below;
  look(tree, 0, below);
  return below;
}

/// A few huge triangles among many small ones, which a builder from above places badly.
Mesh mixedSizes() {
  Mesh mesh = randomTriangles(3000, 0.02f, 31);
  const Mesh huge = randomTriangles(60, 1.0f, 32);
  for (std::size_t t = 0; t < huge.triangles.size(); ++t)
    mesh.add(huge.vertex(t, 0), huge.vertex(t, 1), huge.vertex(t, 2));
  return mesh;
}

}  // namespace

TEST(TreeTop, LowersTheAreaOfTheBoxesAndKeepsEachPrimitiveOnce) {
  const Mesh mesh = mixedSizes();
  BinaryTree tree = buildTree(mesh);
  const Below before = look(tree);
  TreeTop(tree, {}).improve();
  Below after = look(tree);
  EXPECT_LT(after.area, 0.98 * before.area);
  EXPECT_EQ(after.uncovered, 0u);
  std::sort(after.primitives.begin(), after.primitives.end());
  ASSERT_EQ(after.primitives.size(), mesh.triangles.size());
  for (std::uint32_t i = 0; i < after.primitives.size(); ++i) ASSERT_EQ(after.primitives[i], i);
}

TEST(TreeTop, FurtherRoundsNeverCostMore) {
  const Mesh mesh = mixedSizes();
  double last = std::numeric_limits<double>::infinity();
  for (const int rounds : {0, 1, 2, 4, 8}) {
    BinaryTree tree = buildTree(mesh);
    TreeTop(tree, {.rounds = rounds}).improve();
    const double area = look(tree).area;
    EXPECT_LE(area, last) << rounds;
    last = area;
  }
}

TEST(TreeTop, UndoGivesTheSameTreeAgain) {
  BinaryTree tree = buildTree(mixedSizes());
  const Below before = look(tree);
  TreeTop top(tree, {});
  top.improve();
  EXPECT_FALSE(tree.links.empty());
  top.undo();
  const Below after = look(tree);
  EXPECT_TRUE(tree.links.empty());
  EXPECT_EQ(after.primitives, before.primitives);
  EXPECT_EQ(after.area, before.area);
}

TEST(TreeTop, BearsTreesOfAnySize) {
  for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 9u, 20u}) {
    BinaryTree tree = buildTree(randomTriangles(count, 0.5f, 33));
    TreeTop(tree, {.minPrimitives = 2}).improve();
    EXPECT_EQ(look(tree).primitives.size(), count);
    EXPECT_EQ(look(tree).uncovered, 0u);
  }
}

}  // namespace importon::test
