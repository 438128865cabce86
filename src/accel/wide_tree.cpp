#include "accel/wide_tree.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <limits>
#include <memory>

namespace importon {
namespace {

constexpr std::uint32_t kParallelSubtree = 1u << 12;  // primitives from which on children are separate tasks

/// What is best for a binary node that may fill s slots of its wide parent, s = 1 … kBvhWidth.
struct Plan {
  std::array<float, kBvhWidth - 1> costs;         // [s - 1], for at most s < kBvhWidth slots
  std::array<std::uint8_t, kBvhWidth> leftSlots;  // [s - 1], of exactly s > 1 slots
  bool isLeaf;                                    // in one slot: a leaf, else a wide node
};

class Planner {
 public:
  Planner(const BinaryTree& tree, const WideTreeOptions& options)
      : tree_(tree), options_(options), plans_(std::make_unique_for_overwrite<Plan[]>(2 * tree.order.size())) {}

  void plan(std::uint32_t node) {
    if (tree_.nodes[node].isLeaf) {
      plans_[node].costs.fill(leafCost(tree_.nodes[node]));
      plans_[node].isLeaf = true;
      return;
    }
    const std::uint32_t left = BinaryTree::leftChild(node), right = tree_.rightChild(node);
    if (tree_.nodes[node].count >= kParallelSubtree) {
      tbb::parallel_invoke([&] { plan(left); }, [&] { plan(right); });
    } else {
      plan(left);
      plan(right);
    }
    planInner(node, plans_[left], plans_[right]);
  }
  [[nodiscard]] const Plan& operator[](std::uint32_t node) const { return plans_[node]; }

 private:
  void planInner(std::uint32_t nodeIndex, const Plan& left, const Plan& right) {
    const BinaryNode& node = tree_.nodes[nodeIndex];
    Plan& plan = plans_[nodeIndex];
    std::array<float, kBvhWidth> shared;  // cost of sharing exactly s slots among the children
    for (std::uint32_t slots = 2; slots <= kBvhWidth; ++slots) {
      float& best = shared[slots - 1];
      best = std::numeric_limits<float>::infinity();
      plan.leftSlots[slots - 1] = 1;
      for (std::uint32_t l = 1; l < slots; ++l) {
        const float cost = left.costs[l - 1] + right.costs[slots - l - 1];
        if (cost >= best) continue;
        best = cost;
        plan.leftSlots[slots - 1] = static_cast<std::uint8_t>(l);
      }
    }
    const float asNode = node.halfArea() * options_.nodeCost + shared[kBvhWidth - 1];
    plan.isLeaf = node.count <= options_.maxLeafPrimitives && leafCost(node) <= asNode;
    plan.costs[0] = plan.isLeaf ? leafCost(node) : asNode;
    for (std::uint32_t slots = 2; slots < kBvhWidth; ++slots)
      plan.costs[slots - 1] = std::min(shared[slots - 1], plan.costs[slots - 2]);
  }

  [[nodiscard]] float leafCost(const BinaryNode& node) const {
    return node.halfArea() * static_cast<float>(node.count) * options_.intersectionCost;
  }

  const BinaryTree& tree_;
  const WideTreeOptions& options_;
  std::unique_ptr<Plan[]> plans_;
};

/// Lists the children of the wide node that stands for `binaryNode`.
class Collector {
 public:
  Collector(const BinaryTree& tree, const Planner& plans) : tree_(tree), plans_(plans) {}

  [[nodiscard]] WideNode collect(std::uint32_t binaryNode) const {
    WideNode node;
    share(binaryNode, kBvhWidth, node);
    return node;
  }

 private:
  void share(std::uint32_t binaryNode, std::uint32_t slots, WideNode& node) const {
    const Plan& plan = plans_[binaryNode];
    const std::uint32_t left = plan.leftSlots[slots - 1];
    fill(BinaryTree::leftChild(binaryNode), left, node);
    fill(tree_.rightChild(binaryNode), slots - left, node);
  }
  void fill(std::uint32_t binaryNode, std::uint32_t slots, WideNode& node) const {
    const Plan& plan = plans_[binaryNode];
    while (slots > 1 && plan.costs[slots - 1] >= plan.costs[slots - 2]) --slots;
    if (slots > 1) return share(binaryNode, slots, node);
    node.children[node.childCount++] = {binaryNode, plan.isLeaf ? WideNode::kLeaf : 0};
  }

  const BinaryTree& tree_;
  const Planner& plans_;
};

}  // namespace

std::vector<WideNode> buildWideTree(const BinaryTree& tree, const WideTreeOptions& options) {
  Planner plans(tree, options);
  plans.plan(0);
  const Collector collector(tree, plans);
  std::vector<WideNode> nodes;
  if (tree.nodes[0].isLeaf || plans[0].isLeaf) {  // the root is always a node
    nodes.emplace_back().children[0] = {0, WideNode::kLeaf};
    nodes[0].childCount = 1;
    return nodes;
  }
  nodes.push_back(collector.collect(0));
  std::vector<std::uint32_t> stack{0};  // nodes whose children have no index yet
  while (!stack.empty()) {
    const std::uint32_t parent = stack.back();
    stack.pop_back();
    const auto firstChild = static_cast<std::uint32_t>(nodes.size());
    for (std::uint32_t c = 0; c < nodes[parent].childCount; ++c) {
      if (nodes[parent].children[c].wideNode == WideNode::kLeaf) continue;
      nodes[parent].children[c].wideNode = static_cast<std::uint32_t>(nodes.size());
      nodes.push_back(collector.collect(nodes[parent].children[c].binaryNode));
    }
    for (auto child = static_cast<std::uint32_t>(nodes.size()); child-- > firstChild;) stack.push_back(child);
  }
  return nodes;
}

}  // namespace importon
