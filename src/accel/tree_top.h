/// A better top for a binary tree built from above: what was decided before the details were known, decided
/// again.
#pragma once
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "accel/binary_tree.h"

namespace importon {

struct TreeTopOptions {
  std::uint32_t innerNodes = 128;   // that may change their children: those of the largest boxes
  std::uint32_t minPrimitives = 4;  // of such a node
  int rounds = 2;
};

/// Takes subtrees out of the tree, largest boxes first, and puts each where the sum of all boxes' areas grows
/// least [Bittner, Hapala, Havran 2013, Fast insertion-based optimization of bounding volume hierarchies; the
/// search is theirs, section 3.1]. Only the nodes of the largest boxes take part, as they make most of a ray's
/// steps; so the time does not grow with the tree. The same result always: it runs on one thread.
class TreeTop {
 public:
  /// Keeps a reference to the tree.
  TreeTop(BinaryTree& tree, const TreeTopOptions& options);

  /// Changes the links of the tree. Paths may become longer than kBvhMaxDepth; undo() then.
  void improve();
  /// Makes the tree again what it was.
  void undo();

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  struct Node {
    Box box;
    std::uint32_t source;                       // in the tree
    std::uint32_t parent = kNone;               // in nodes_, as the next two
    std::uint32_t left = kNone, right = kNone;  // kNone: a subtree that stays as it is
  };
  struct Place {
    float cost;  // growth of all boxes
    std::uint32_t sibling;
  };

  void takeNodes();
  void reinsert(std::uint32_t node);
  void detach(std::uint32_t node, std::uint32_t parent);
  void attach(std::uint32_t node, std::uint32_t parent, std::uint32_t sibling);
  [[nodiscard]] float costBeside(const Box& box, std::uint32_t sibling) const;
  [[nodiscard]] Place findPlace(const Box& box, Place best);
  void refit(std::uint32_t node);
  std::uint32_t store(std::uint32_t node);

  BinaryTree& tree_;
  TreeTopOptions options_;
  std::vector<Node> nodes_;
  std::vector<std::pair<std::uint32_t, BinaryNode>> before_;  // what improve() has overwritten
  std::vector<std::pair<float, std::uint32_t>> queue_;        // of findPlace()
};

}  // namespace importon
