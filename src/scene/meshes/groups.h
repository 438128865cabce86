/// What belongs together.
#pragma once
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace importon {

/// Things 0 .. count - 1, each at first in a group of its own. A group is known by its least.
template <class Index>
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), Index{0}); }

  Index of(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(Index a, Index b) {
    const Index first = of(a), second = of(b);
    parent_[std::max(first, second)] = std::min(first, second);
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace importon
