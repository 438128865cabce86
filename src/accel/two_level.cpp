#include "accel/two_level.h"

#include <algorithm>
#include <bit>

#include "accel/binary_tree.h"
#include "accel/encode.h"
#include "accel/wide_tree.h"

namespace importon {
namespace {

constexpr std::size_t kWorldParts = 64;  // into which the world's tree is cut open
constexpr std::uint32_t kHalfDepth = kBvhMaxDepth / 2;

/// A leaf of the upper tree: the record, and the box of what is in it.
struct Part {
  BvhRecord record;
  Box box;
};

BvhRecord makeBvhInstance(std::uint32_t instance) {
  BvhInstance record{};
  record.instance = instance;
  record.kind = kBvhInstance;
  return std::bit_cast<BvhRecord>(record);
}

/// A record of a tree that comes to stand `records` later, its triangles `triangles` later.
BvhRecord moved(BvhRecord record, std::uint32_t records, std::uint32_t triangles) {
  if (isLeaf(record)) {
    BvhTriangle leaf = asTriangle(record);
    leaf.triangle += triangles;
    if (leaf.next != 0) leaf.next += records;
    return std::bit_cast<BvhRecord>(leaf);
  }
  if (record[11] != kBvhInner) return record;
  BvhNode node = asNode(record);
  node.firstChild += records;
  return std::bit_cast<BvhRecord>(node);
}

/// Those of `tree` to the end of `to`. Returns the place of its root there.
std::uint32_t append(LargeVector<BvhRecord>& to, const Bvh& tree, std::uint32_t firstTriangle) {
  const auto root = static_cast<std::uint32_t>(to.size());
  checkBvhSize(to.size() + tree.nodes.size());
  for (const BvhRecord& record : tree.nodes) to.push_back(moved(record, root, firstTriangle));
  return root;
}

/// What the child's box holds, wherever rounding put its planes.
Box wideChildBox(const BvhNode& node, std::uint32_t slot) {
  constexpr float kRounding = 1.0f / (1 << 22);
  Box box = childBox(node, slot);
  const Float4 reach = max4(box.hi, -box.lo);
  const float margin = kRounding * std::max({reach[0], reach[1], reach[2]});
  return {box.lo - margin, box.hi + margin};
}

/// The parts of a tree without their common ancestors, of which always that of the largest box is opened next.
std::vector<Part> openTree(const Bvh& tree) {
  std::vector<Part> parts;
  const auto open = [&](const BvhNode& node) {
    for (std::uint32_t slot = 0; slot < kBvhWidth; ++slot)
      if (hasChild(node, slot)) parts.push_back({tree.nodes[node.firstChild + slot], wideChildBox(node, slot)});
  };
  open(asNode(tree.nodes[0]));
  while (parts.size() < kWorldParts) {
    std::size_t largest = parts.size();
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (!isLeaf(parts[i].record) &&
          (largest == parts.size() || parts[i].box.halfArea() > parts[largest].box.halfArea()))
        largest = i;
    if (largest == parts.size()) break;
    const BvhNode node = asNode(parts[largest].record);
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(largest));
    open(node);
  }
  return parts;
}

/// A tree whose leaves are instances that are numbered as the parts are.
Bvh buildUpperTree(const std::vector<Part>& parts, std::uint32_t sahDepth) {
  LargeVector<PrimitiveBox> boxes(parts.size());
  std::vector<BvhRecord> records(parts.size());
  for (std::uint32_t i = 0; i < parts.size(); ++i) {
    boxes[i] = parts[i].box;
    setPrimitiveIndex(boxes[i], i);
    records[i] = makeBvhInstance(i);
  }
  BuildProgress progress({}, parts.size());
  const BinaryTree binary = buildBinaryTree(std::move(boxes), {.maxLeafPrimitives = 1, .sahDepth = sahDepth}, progress);
  const WideTree wide(binary, {.maxLeafPrimitives = 1});
  return {encodeBvh(binary, wide, records), wide.depth(), {}};
}

Bvh buildUpperTree(const std::vector<Part>& parts) {
  Bvh upper = buildUpperTree(parts, BinaryTreeOptions{}.sahDepth);
  const auto bits = static_cast<std::uint32_t>(std::bit_width(parts.size()));
  return upper.depth <= kHalfDepth ? upper : buildUpperTree(parts, kHalfDepth - std::min(bits + 1, kHalfDepth));
}

}  // namespace

Bvh buildTwoLevelBvh(const PlacedTrees& trees, const BvhOptions& options) {
  BvhOptions lower = options;
  lower.mostDepth = kHalfDepth;
  const Bvh world = buildBvh(trees.positions, trees.world, lower);
  std::vector<Part> parts = trees.world.empty() ? std::vector<Part>() : openTree(world);
  const std::size_t worldParts = parts.size();
  for (std::uint32_t i = 0; i < trees.instances.size(); ++i)
    parts.push_back({makeBvhInstance(i + 1), trees.instances[i]});
  Bvh all = buildUpperTree(parts);
  const auto upperSize = static_cast<std::uint32_t>(all.nodes.size());  // where the rest of the world's tree will stand
  for (BvhRecord& record : all.nodes) {
    if (record[11] != kBvhInstance) continue;
    const std::uint32_t part = std::bit_cast<BvhInstance>(record).instance;
    record = part < worldParts ? moved(parts[part].record, upperSize, 0) : parts[part].record;
  }
  if (worldParts > 0) (void)append(all.nodes, world, 0);
  std::uint32_t deepest = world.depth;
  for (const PlacedTrees::Mesh& mesh : trees.meshes) {
    const Bvh tree = buildBvh(trees.positions, mesh.triangles, lower);
    all.meshRoots.push_back(append(all.nodes, tree, mesh.firstTriangle));
    deepest = std::max(deepest, tree.depth);
  }
  all.depth += deepest;
  return all;
}

}  // namespace importon
