#include "accel/binary_tree.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <atomic>

namespace importon {
namespace {

constexpr std::uint32_t kMaxBins = 32;
constexpr std::uint32_t kParallelRange = 1u << 15;    // primitives from which on one node is worked on in parallel
constexpr std::uint32_t kParallelSubtree = 1u << 11;  // primitives from which on children are separate tasks
constexpr std::uint32_t kChunk = 1u << 12;            // primitives of a chunk in parallel partitioning

typedef std::int32_t Int4 __attribute__((vector_size(16)));

/// Twice the centre of a box; lane 3 is zero.
Float4 doubleCentre(const PrimitiveBox& box) {
  Float4 centre = box.lo + box.hi;
  centre[3] = 0.0f;
  return centre;
}

/// Maps double centres to bins, the same for counting and for partitioning.
struct BinMap {
  Float4 origin, scale;
  std::int32_t bins;

  BinMap(const Box& centres, std::uint32_t count)
      : origin(centres.lo), bins(static_cast<std::int32_t>(std::min(kMaxBins, 4 + count / 20))) {
    const Float4 extent = centres.hi - centres.lo;
    for (int axis = 0; axis < 3; ++axis) {
      const float ratio = 0.99f * static_cast<float>(bins) / extent[axis];
      scale[axis] = extent[axis] > 0.0f && ratio < 1e30f ? ratio : 0.0f;
    }
    origin[3] = scale[3] = 0.0f;
  }
  [[nodiscard]] Int4 operator()(const PrimitiveBox& box) const {
    const Int4 bin = __builtin_convertvector((doubleCentre(box) - origin) * scale, Int4);
    const Int4 last = {bins - 1, bins - 1, bins - 1, bins - 1};
    return bin < last ? bin : last;
  }
};

struct Bins {
  std::array<std::array<Box, kMaxBins>, 3> boxes;
  std::array<std::array<std::uint32_t, kMaxBins>, 3> counts;

  explicit Bins(std::int32_t used) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::fill_n(boxes[axis].begin(), used, Box::empty());
      std::fill_n(counts[axis].begin(), used, 0u);
    }
  }
  void add(const PrimitiveBox* begin, const PrimitiveBox* end, const BinMap& map) {
    for (const PrimitiveBox* box = begin; box != end; ++box) {
      const Int4 bin = map(*box);
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const auto b = static_cast<std::size_t>(bin[axis]);
        boxes[a][b].include(*box);
        ++counts[a][b];
      }
    }
  }
  void merge(const Bins& other, std::int32_t used) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t b = 0; b < static_cast<std::size_t>(used); ++b) {
        boxes[axis][b].include(other.boxes[axis][b]);
        counts[axis][b] += other.counts[axis][b];
      }
  }
};

struct Split {
  int axis = -1;                                        // -1: none
  std::int32_t bin = 0;                                 // bins below it go left
  float cost = std::numeric_limits<float>::infinity();  // sum of half areas times primitives
  std::uint32_t leftCount = 0;
  Box leftBox, rightBox;
};

/// The cheapest plane between bins of one axis, if it beats `best`.
void findSplit(const Bins& bins, int axis, std::int32_t used, std::uint32_t total, Split& best) {
  const auto a = static_cast<std::size_t>(axis);
  std::array<float, kMaxBins> rightCosts;
  Box box = Box::empty();
  std::uint32_t count = 0;
  for (auto b = static_cast<std::size_t>(used) - 1; b > 0; --b) {
    box.include(bins.boxes[a][b]);
    count += bins.counts[a][b];
    rightCosts[b] = count == 0 ? 0.0f : box.halfArea() * static_cast<float>(count);
  }
  box = Box::empty();
  count = 0;
  for (std::size_t b = 1; b < static_cast<std::size_t>(used); ++b) {
    box.include(bins.boxes[a][b - 1]);
    count += bins.counts[a][b - 1];
    if (count == 0 || count == total) continue;
    const float cost = box.halfArea() * static_cast<float>(count) + rightCosts[b];
    if (cost >= best.cost) continue;
    best.axis = axis;
    best.bin = static_cast<std::int32_t>(b);
    best.cost = cost;
    best.leftCount = count;
  }
}

class Builder {
 public:
  Builder(PrimitiveBox* boxes, PrimitiveBox* spare, const BinaryTreeOptions& options, BinaryTree& tree,
          BuildProgress& progress)
      : buffers_{boxes, spare}, options_(options), tree_(tree), progress_(progress) {}

  void build(std::uint32_t node, int source, std::uint32_t first, std::uint32_t count, const Box& box,
             const Box& centres, std::uint32_t depth) const;
  [[nodiscard]] std::uint32_t coincident() const { return coincident_.load(std::memory_order_relaxed); }

 private:
  struct Centres {
    Box left = Box::empty(), right = Box::empty();
  };
  [[nodiscard]] Split chooseSplit(const PrimitiveBox* begin, std::uint32_t count, const BinMap& map) const;
  [[nodiscard]] Centres partition(const PrimitiveBox* from, PrimitiveBox* to, std::uint32_t count, const Split& split,
                                  const BinMap& map) const;
  [[nodiscard]] Centres partitionParallel(const PrimitiveBox* from, PrimitiveBox* to, std::uint32_t count,
                                          const Split& split, const BinMap& map) const;
  [[nodiscard]] Centres halve(const PrimitiveBox* from, PrimitiveBox* to, std::uint32_t count, Split& split) const;
  void noteCoincident(std::uint32_t count) const;
  void makeLeaf(BinaryNode& node, int source, std::uint32_t first, std::uint32_t count) const;

  std::array<PrimitiveBox*, 2> buffers_;
  const BinaryTreeOptions& options_;
  BinaryTree& tree_;
  BuildProgress& progress_;
  mutable std::atomic<std::uint32_t> coincident_{0};
};

Split Builder::chooseSplit(const PrimitiveBox* begin, std::uint32_t count, const BinMap& map) const {
  Split best;
  const auto search = [&](const Bins& bins) {
    for (int axis = 0; axis < 3; ++axis)
      if (map.scale[axis] > 0.0f) findSplit(bins, axis, map.bins, count, best);
    if (best.axis < 0) return;
    best.leftBox = best.rightBox = Box::empty();
    const auto& boxes = bins.boxes[static_cast<std::size_t>(best.axis)];
    for (std::int32_t b = 0; b < map.bins; ++b)
      (b < best.bin ? best.leftBox : best.rightBox).include(boxes[static_cast<std::size_t>(b)]);
  };
  if (count < kParallelRange) {
    Bins bins(map.bins);
    bins.add(begin, begin + count, map);
    search(bins);
    return best;
  }
  search(tbb::parallel_reduce(
      tbb::blocked_range<std::uint32_t>(0, count, kChunk), Bins(map.bins),
      [&](const tbb::blocked_range<std::uint32_t>& range, Bins bins) {
        bins.add(begin + range.begin(), begin + range.end(), map);
        return bins;
      },
      [&](Bins a, const Bins& b) {
        a.merge(b, map.bins);
        return a;
      }));
  return best;
}

/// Stable to the left, reversed to the right: a fixed order.
Builder::Centres Builder::partition(const PrimitiveBox* from, PrimitiveBox* to, std::uint32_t count, const Split& split,
                                    const BinMap& map) const {
  Centres centres;
  PrimitiveBox* left = to;
  PrimitiveBox* right = to + count;
  for (const PrimitiveBox* box = from; box != from + count; ++box) {
    const Float4 centre = doubleCentre(*box);
    if (map(*box)[split.axis] < split.bin) {
      *left++ = *box;
      centres.left.include(centre);
    } else {
      *--right = *box;
      centres.right.include(centre);
    }
  }
  return centres;
}

/// As partition(), by chunks of fixed size whose places are known from a first pass that counts.
Builder::Centres Builder::partitionParallel(const PrimitiveBox* from, PrimitiveBox* to, std::uint32_t count,
                                            const Split& split, const BinMap& map) const {
  const std::uint32_t chunks = (count + kChunk - 1) / kChunk;
  std::vector<std::uint32_t> leftBefore(chunks + 1, 0);
  std::vector<Centres> chunkCentres(chunks);
  tbb::parallel_for(0u, chunks, [&](std::uint32_t chunk) {
    const PrimitiveBox* begin = from + chunk * kChunk;
    const PrimitiveBox* end = from + std::min(count, (chunk + 1) * kChunk);
    leftBefore[chunk + 1] = static_cast<std::uint32_t>(
        std::count_if(begin, end, [&](const PrimitiveBox& box) { return map(box)[split.axis] < split.bin; }));
  });
  for (std::uint32_t chunk = 0; chunk < chunks; ++chunk) leftBefore[chunk + 1] += leftBefore[chunk];
  tbb::parallel_for(0u, chunks, [&](std::uint32_t chunk) {
    const std::uint32_t begin = chunk * kChunk, end = std::min(count, begin + kChunk);
    PrimitiveBox* left = to + leftBefore[chunk];
    PrimitiveBox* right = to + split.leftCount + (begin - leftBefore[chunk]);
    Centres& centres = chunkCentres[chunk];
    for (const PrimitiveBox* box = from + begin; box != from + end; ++box) {
      const bool isLeft = map(*box)[split.axis] < split.bin;
      (isLeft ? centres.left : centres.right).include(doubleCentre(*box));
      *(isLeft ? left : right)++ = *box;
    }
  });
  Centres centres;
  for (const Centres& part : chunkCentres) {
    centres.left.include(part.left);
    centres.right.include(part.right);
  }
  return centres;
}

/// Where no plane separates the centres: the first half goes left.
Builder::Centres Builder::halve(const PrimitiveBox* from, PrimitiveBox* to, std::uint32_t count, Split& split) const {
  Centres centres;
  split.leftCount = count / 2;
  split.leftBox = split.rightBox = Box::empty();
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool isLeft = i < split.leftCount;
    (isLeft ? split.leftBox : split.rightBox).include(from[i]);
    (isLeft ? centres.left : centres.right).include(doubleCentre(from[i]));
    to[i] = from[i];
  }
  return centres;
}

void Builder::noteCoincident(std::uint32_t count) const {
  std::uint32_t most = coincident_.load(std::memory_order_relaxed);
  while (most < count && !coincident_.compare_exchange_weak(most, count, std::memory_order_relaxed)) {
  }
}

void Builder::makeLeaf(BinaryNode& node, int source, std::uint32_t first, std::uint32_t count) const {
  node.isLeaf = 1;
  const PrimitiveBox* boxes = buffers_[static_cast<std::size_t>(source)];
  for (std::uint32_t i = first; i < first + count; ++i) tree_.order[i] = primitiveIndex(boxes[i]);
  std::sort(tree_.order.begin() + first, tree_.order.begin() + first + count);
}

void Builder::build(std::uint32_t nodeIndex, int source, std::uint32_t first, std::uint32_t count, const Box& box,
                    const Box& centres, std::uint32_t depth) const {
  BinaryNode& node = tree_.nodes[nodeIndex];
  for (int axis = 0; axis < 3; ++axis) {
    node.lo[axis] = box.lo[axis];
    node.hi[axis] = box.hi[axis];
  }
  node.first = first;
  node.count = count & kMaxPrimitives;
  node.hasLinks = 0;
  node.isLeaf = 0;
  if (count == 1) return makeLeaf(node, source, first, count);

  const PrimitiveBox* from = buffers_[static_cast<std::size_t>(source)] + first;
  PrimitiveBox* to = buffers_[static_cast<std::size_t>(1 - source)] + first;
  const BinMap map(centres, count);
  Split split;
  if (count == 2)
    split.cost = from[0].halfArea() + from[1].halfArea();  // nothing to choose
  else if (depth < options_.sahDepth)
    split = chooseSplit(from, count, map);
  if (split.axis < 0 && depth < options_.sahDepth && count > 2) noteCoincident(count);
  if (count <= options_.maxLeafPrimitives) {
    const float area = box.halfArea();
    const float leafCost = options_.intersectionCost * static_cast<float>(count) * area;
    const float splitCost = options_.traversalCost * area + options_.intersectionCost * split.cost;
    if (leafCost <= splitCost) return makeLeaf(node, source, first, count);
  }
  Centres parts;
  if (split.axis < 0)
    parts = halve(from, to, count, split);
  else if (count < kParallelRange)
    parts = partition(from, to, count, split, map);
  else
    parts = partitionParallel(from, to, count, split, map);

  const std::uint32_t left = nodeIndex + 1, right = nodeIndex + 2 * split.leftCount;
  const auto buildLeft = [&] { build(left, 1 - source, first, split.leftCount, split.leftBox, parts.left, depth + 1); };
  const auto buildRight = [&] {
    build(right, 1 - source, first + split.leftCount, count - split.leftCount, split.rightBox, parts.right, depth + 1);
  };
  if (count < kParallelSubtree) {
    buildLeft();
    buildRight();
    return;
  }
  tbb::parallel_invoke(buildLeft, buildRight);
  for (const std::uint32_t done : {split.leftCount, count - split.leftCount})
    if (done < kParallelSubtree) progress_.add(done);
}

}  // namespace

BinaryTree buildBinaryTree(LargeVector<PrimitiveBox> boxes, const BinaryTreeOptions& options, BuildProgress& progress) {
  const auto count = static_cast<std::uint32_t>(boxes.size());
  BinaryTree tree;
  tree.nodes.resize(2 * boxes.size());
  tree.order.resize(count);
  struct Bounds {
    Box box = Box::empty(), centres = Box::empty();
  };
  const Bounds bounds = tbb::parallel_reduce(
      tbb::blocked_range<std::uint32_t>(0, count, kChunk), Bounds(),
      [&](const tbb::blocked_range<std::uint32_t>& range, Bounds part) {
        for (std::uint32_t i = range.begin(); i < range.end(); ++i) {
          part.box.include(boxes[i]);
          part.centres.include(doubleCentre(boxes[i]));
        }
        return part;
      },
      [](Bounds a, const Bounds& b) {
        a.box.include(b.box);
        a.centres.include(b.centres);
        return a;
      });
  LargeVector<PrimitiveBox> spare(boxes.size());
  const Builder builder(boxes.data(), spare.data(), options, tree, progress);
  builder.build(0, 0, 0, count, bounds.box, bounds.centres, 0);
  tree.coincident = builder.coincident();
  return tree;
}

}  // namespace importon
