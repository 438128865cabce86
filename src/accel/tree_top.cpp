#include "accel/tree_top.h"

#include <algorithm>

namespace importon {
namespace {

Box boxOf(const BinaryNode& node) {
  return {Float4{node.lo[0], node.lo[1], node.lo[2], 0.0f}, Float4{node.hi[0], node.hi[1], node.hi[2], 0.0f}};
}

float unionHalfArea(Box a, const Box& b) {
  a.include(b);
  return a.halfArea();
}

}  // namespace

TreeTop::TreeTop(BinaryTree& tree, const TreeTopOptions& options) : tree_(tree), options_(options) { takeNodes(); }

/// Opens the node of the largest box, again and again.
void TreeTop::takeNodes() {
  std::vector<std::pair<float, std::uint32_t>> open;
  const auto take = [&](std::uint32_t source, std::uint32_t parent) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({boxOf(tree_.nodes[source]), source, parent});
    if (!tree_.nodes[source].isLeaf && tree_.nodes[source].count >= options_.minPrimitives) {
      open.emplace_back(nodes_[index].box.halfArea(), index);
      std::push_heap(open.begin(), open.end());
    }
    return index;
  };
  take(0, kNone);
  for (std::uint32_t i = 0; i < options_.innerNodes && !open.empty(); ++i) {
    std::pop_heap(open.begin(), open.end());
    const std::uint32_t node = open.back().second, source = nodes_[node].source;
    open.pop_back();
    const std::uint32_t left = take(tree_.leftChild(source), node), right = take(tree_.rightChild(source), node);
    nodes_[node].left = left;
    nodes_[node].right = right;
  }
}

void TreeTop::improve() {
  if (nodes_.size() < 4) return;  // nothing has a grandparent
  std::vector<std::pair<float, std::uint32_t>> order;
  for (int round = 0; round < options_.rounds; ++round) {
    order.clear();
    for (std::uint32_t node = 1; node < nodes_.size(); ++node) order.emplace_back(-nodes_[node].box.halfArea(), node);
    std::sort(order.begin(), order.end());
    for (const auto& [area, node] : order)
      if (nodes_[node].parent != 0) reinsert(node);
  }
  (void)store(0);
}

void TreeTop::reinsert(std::uint32_t node) {
  const std::uint32_t parent = nodes_[node].parent;
  const std::uint32_t sibling = nodes_[parent].left == node ? nodes_[parent].right : nodes_[parent].left;
  detach(node, parent);
  const Box& box = nodes_[node].box;
  attach(node, parent, findPlace(box, {costBeside(box, sibling), sibling}).sibling);
}

/// Its sibling takes the place of its parent, which is left without links.
void TreeTop::detach(std::uint32_t node, std::uint32_t parent) {
  const std::uint32_t sibling = nodes_[parent].left == node ? nodes_[parent].right : nodes_[parent].left;
  const std::uint32_t above = nodes_[parent].parent;
  (nodes_[above].left == parent ? nodes_[above].left : nodes_[above].right) = sibling;
  nodes_[sibling].parent = above;
  refit(above);
}

/// `parent` takes the place of `sibling`, and has both as its children.
void TreeTop::attach(std::uint32_t node, std::uint32_t parent, std::uint32_t sibling) {
  const std::uint32_t above = nodes_[sibling].parent;
  (nodes_[above].left == sibling ? nodes_[above].left : nodes_[above].right) = parent;
  nodes_[parent].parent = above;
  nodes_[parent].left = sibling;
  nodes_[parent].right = node;
  nodes_[sibling].parent = nodes_[node].parent = parent;
  refit(parent);
}

float TreeTop::costBeside(const Box& box, std::uint32_t sibling) const {
  float cost = unionHalfArea(nodes_[sibling].box, box);
  for (std::uint32_t node = nodes_[sibling].parent; node != kNone; node = nodes_[node].parent)
    cost += unionHalfArea(nodes_[node].box, box) - nodes_[node].box.halfArea();
  return cost;
}

/// Branch and bound: below a node it costs at least what its ancestors grow, and the box itself.
TreeTop::Place TreeTop::findPlace(const Box& box, Place best) {
  const auto isLater = [](const auto& a, const auto& b) { return a > b; };
  const float least = box.halfArea();
  queue_.assign(1, {0.0f, 0});  // growth of the ancestors, node
  while (!queue_.empty()) {
    std::pop_heap(queue_.begin(), queue_.end(), isLater);
    const auto [growth, node] = queue_.back();
    queue_.pop_back();
    if (growth + least >= best.cost) break;
    const float cost = growth + unionHalfArea(nodes_[node].box, box);
    if (cost < best.cost && node != 0) best = {cost, node};
    const float growthBelow = cost - nodes_[node].box.halfArea();
    if (nodes_[node].left == kNone || growthBelow + least >= best.cost) continue;
    for (const std::uint32_t child : {nodes_[node].left, nodes_[node].right}) {
      queue_.emplace_back(growthBelow, child);
      std::push_heap(queue_.begin(), queue_.end(), isLater);
    }
  }
  return best;
}

/// The boxes of a node and of all above it.
void TreeTop::refit(std::uint32_t node) {
  for (; node != kNone; node = nodes_[node].parent) {
    Box box = nodes_[nodes_[node].left].box;
    box.include(nodes_[nodes_[node].right].box);
    nodes_[node].box = box;
  }
}

/// Writes a node and all below it to the tree. Returns the primitives below.
std::uint32_t TreeTop::store(std::uint32_t index) {
  const Node& node = nodes_[index];
  BinaryNode& out = tree_.nodes[node.source];
  if (node.left == kNone) return out.count;
  before_.emplace_back(node.source, out);
  const std::uint32_t count = store(node.left) + store(node.right);
  for (int axis = 0; axis < 3; ++axis) {
    out.lo[axis] = node.box.lo[axis];
    out.hi[axis] = node.box.hi[axis];
  }
  out.count = count & kMaxPrimitives;
  out.hasLinks = 1;
  out.first = static_cast<std::uint32_t>(tree_.links.size());
  tree_.links.push_back({nodes_[node.left].source, nodes_[node.right].source});
  return count;
}

void TreeTop::undo() {
  for (const auto& [source, node] : before_) tree_.nodes[source] = node;
  tree_.links.clear();
  before_.clear();
}

}  // namespace importon
