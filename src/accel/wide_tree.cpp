#include "accel/wide_tree.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace importon {
namespace {

constexpr std::uint32_t kParallelSubtree = 1u << 12;  // primitives from which on children are separate tasks
constexpr std::uint32_t kMaxRecords = 1u << 30;       // more than any tree may have

}  // namespace

/// For at most s slots, s = 1 … kBvhWidth: the best cost, and what then lies in the slots and below.
struct WideTree::Plan {
  std::array<float, kBvhWidth> costs;
  std::array<std::uint32_t, kBvhWidth> records;  // those in the slots included
  std::array<std::uint32_t, kBvhWidth> depths;   // wide nodes on the longest path
};

WideTree::WideTree(const BinaryTree& tree, const WideTreeOptions& options)
    : tree_(tree), options_(options), choices_(2 * tree.order.size()) {
  depth_ = plan(0).depths[0];
}

WideTree::Plan WideTree::plan(std::uint32_t node) {
  if (tree_.nodes[node].isLeaf) return planLeaf(node);
  const std::uint32_t left = tree_.leftChild(node), right = tree_.rightChild(node);
  if (tree_.nodes[node].count < kParallelSubtree) {
    const Plan leftPlan = plan(left);
    return planInner(node, leftPlan, plan(right));
  }
  Plan leftPlan, rightPlan;
  tbb::parallel_invoke([&] { leftPlan = plan(left); }, [&] { rightPlan = plan(right); });
  return planInner(node, leftPlan, rightPlan);
}

WideTree::Plan WideTree::planLeaf(std::uint32_t node) {
  const std::uint32_t count = tree_.nodes[node].count;
  choices_[node] = {count - 1, {}, true};
  Plan plan;
  plan.costs.fill(leafCost(tree_.nodes[node]));
  plan.records.fill(count);
  plan.depths.fill(0);
  return plan;
}

WideTree::Plan WideTree::planInner(std::uint32_t nodeIndex, const Plan& left, const Plan& right) {
  const BinaryNode& node = tree_.nodes[nodeIndex];
  Choice choice{};
  Plan plan;
  for (std::uint32_t slots = 2; slots <= kBvhWidth; ++slots) {
    float best = std::numeric_limits<float>::infinity();
    std::uint32_t leftSlots = 1;
    for (std::uint32_t l = 1; l < slots; ++l) {
      const float cost = left.costs[l - 1] + right.costs[slots - l - 1];
      if (cost >= best) continue;
      best = cost;
      leftSlots = l;
    }
    plan.costs[slots - 1] = best;
    plan.records[slots - 1] = std::min(left.records[leftSlots - 1] + right.records[slots - leftSlots - 1], kMaxRecords);
    plan.depths[slots - 1] = std::max(left.depths[leftSlots - 1], right.depths[slots - leftSlots - 1]);
    choice.leftSlots[slots - 2] = static_cast<std::uint8_t>(leftSlots);
  }
  const float asNode = node.halfArea() * options_.nodeCost + plan.costs[kBvhWidth - 1];
  choice.isLeaf =
      nodeIndex != 0 && !node.hasLinks && node.count <= options_.maxLeafPrimitives && leafCost(node) <= asNode;
  choice.recordsBelow = choice.isLeaf ? node.count - 1 : plan.records[kBvhWidth - 1];
  plan.costs[0] = choice.isLeaf ? leafCost(node) : asNode;
  plan.records[0] = choice.recordsBelow + 1;
  plan.depths[0] = choice.isLeaf ? 0 : plan.depths[kBvhWidth - 1] + 1;
  for (std::uint32_t slots = 2; slots < kBvhWidth; ++slots) {
    if (plan.costs[slots - 1] < plan.costs[slots - 2]) continue;
    plan.costs[slots - 1] = plan.costs[slots - 2];
    plan.records[slots - 1] = plan.records[slots - 2];
    plan.depths[slots - 1] = plan.depths[slots - 2];
    choice.leftSlots[slots - 2] = 0;
  }
  choices_[nodeIndex] = choice;
  return plan;
}

float WideTree::leafCost(const BinaryNode& node) const {
  return node.halfArea() * static_cast<float>(node.count) * options_.intersectionCost;
}

WideChildren WideTree::children(std::uint32_t node) const {
  WideChildren children;
  if (tree_.nodes[node].isLeaf)  // of the root
    children.nodes[children.count++] = node;
  else
    fill(node, kBvhWidth, children);
  if (!options_.listsLeavesFirst) return children;
  const auto begin = children.nodes.begin(), end = begin + children.count;
  for (auto last = begin + 1; last < end; ++last)
    for (auto i = last; i != begin && comesBefore(*i, *(i - 1)); --i) std::swap(*i, *(i - 1));
  return children;
}

bool WideTree::comesBefore(std::uint32_t a, std::uint32_t b) const {
  if (isLeaf(a) != isLeaf(b)) return isLeaf(a);
  return tree_.nodes[a].halfArea() < tree_.nodes[b].halfArea();
}

void WideTree::fill(std::uint32_t node, std::uint32_t slots, WideChildren& children) const {
  const Choice& choice = choices_[node];
  while (slots > 1 && choice.leftSlots[slots - 2] == 0) --slots;
  if (slots == 1) {
    children.nodes[children.count++] = node;
    return;
  }
  const std::uint32_t left = choice.leftSlots[slots - 2];
  fill(tree_.leftChild(node), left, children);
  fill(tree_.rightChild(node), slots - left, children);
}

}  // namespace importon
