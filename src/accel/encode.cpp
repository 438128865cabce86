#include "accel/encode.h"

#include <fmt/format.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace importon {
namespace {

constexpr int kLastStep = 255;
constexpr int kExponentBias = 127;
/// A low exponent that leaves room for products with reciprocal directions.
constexpr int kLeastExponent = -100;
/// Every plane of a child's box stands off the child by at least this many grid steps, which covers the
/// rounding of the kernel's arithmetic in steps: 5 roundings of at most 256 steps each are 256 · 5 · 2^-24 <
/// 2^-13.
constexpr double kMargin = 1.0 / 1024;

/// 2^exponent.
double powerOfTwo(int exponent) {
  constexpr int kDoubleBias = 1023, kDoubleMantissaBits = 52;
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + kDoubleBias) << kDoubleMantissaBits);
}

/// Grid of one axis: planes at origin + byte · 2^exponent.
struct Grid {
  float origin;
  int exponent;
  double stepsPerMetre;

  /// The last plane that stands off to the low side of `value`; negative: none.
  [[nodiscard]] int below(float value) const { return static_cast<int>(steps(value) - kMargin + 1.0) - 1; }
  /// The first plane that stands off to the high side.
  [[nodiscard]] int above(float value) const { return static_cast<int>(steps(value) + kMargin) + 1; }

 private:
  [[nodiscard]] double steps(float value) const {
    return (static_cast<double>(value) - static_cast<double>(origin)) * stepsPerMetre;
  }
};

float roundDown(double value) {
  const auto nearest = static_cast<float>(value);
  if (static_cast<double>(nearest) <= value) return nearest;
  return std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}

/// The finest grid that reaches from below `low` to above `high`.
Grid makeGrid(float low, float high) {
  const double extent = static_cast<double>(high) - static_cast<double>(low);
  int exponent = kLeastExponent;
  if (extent > 0.0) {
    std::frexp(extent / (kLastStep - 1), &exponent);
    exponent = std::max(exponent - 1, kLeastExponent);
  }
  for (;; ++exponent) {
    const float origin = roundDown(static_cast<double>(low) - kMargin * powerOfTwo(exponent));
    const Grid grid{origin, exponent, powerOfTwo(-exponent)};
    if (grid.above(high) <= kLastStep && grid.below(low) >= 0) return grid;
  }
}

float squaredLength(vec3 v) { return glm::dot(v, v); }

/// `MakeLeaf` makes the record of a primitive from its index and the record of the leaf's next one.
template <class MakeLeaf>
class Encoder {
 public:
  Encoder(const BinaryTree& binary, const WideTree& wide, MakeLeaf makeLeaf, std::span<BvhRecord> records)
      : binary_(binary), wide_(wide), makeLeaf_(makeLeaf), records_(records) {}

  /// The node itself as record `place`, and all below it from record `firstChild` on.
  void encode(std::uint32_t node, std::uint32_t place, std::uint32_t firstChild) const {
    const WideChildren children = wide_.children(node);
    std::array<Box, kBvhWidth> boxes;
    std::uint32_t next = firstChild + children.count;
    for (std::uint32_t slot = 0; slot < children.count; ++slot) {
      const BinaryNode& child = binary_.nodes[children.nodes[slot]];
      boxes[slot] = {Float4{child.lo[0], child.lo[1], child.lo[2], 0.0f},
                     Float4{child.hi[0], child.hi[1], child.hi[2], 0.0f}};
      if (wide_.isLeaf(children.nodes[slot])) next = encodeLeaf(child, firstChild + slot, next);
    }
    records_[place] = makeBvhNode(std::span(boxes).first(children.count), firstChild);
    if (binary_.nodes[node].count < kParallelSubtree)
      encodeInner(children, firstChild, next);
    else
      encodeInParallel(children, firstChild, next);
  }

 private:
  static constexpr std::uint32_t kParallelSubtree = 1u << 12;  // primitives

  /// The children that are nodes, the subtree of the first from record `next` on.
  void encodeInner(const WideChildren& children, std::uint32_t firstChild, std::uint32_t next) const {
    for (std::uint32_t slot = 0; slot < children.count; ++slot) {
      const std::uint32_t child = children.nodes[slot];
      if (wide_.isLeaf(child)) continue;
      encode(child, firstChild + slot, next);
      next += wide_.recordsBelow(child);
    }
  }
  /// The same, each on a thread of its own if there is one.
  void encodeInParallel(const WideChildren& children, std::uint32_t firstChild, std::uint32_t next) const {
    tbb::task_group tasks;
    for (std::uint32_t slot = 0; slot < children.count; ++slot) {
      const std::uint32_t child = children.nodes[slot];
      if (wide_.isLeaf(child)) continue;
      tasks.run([this, child, next, place = firstChild + slot] { encode(child, place, next); });
      next += wide_.recordsBelow(child);
    }
    tasks.wait();
  }

  /// Its first triangle is record `record`, the rest from `spare` on. Returns what is spare then.
  std::uint32_t encodeLeaf(const BinaryNode& leaf, std::uint32_t record, std::uint32_t spare) const {
    for (std::uint32_t i = 0; i < leaf.count; ++i) {
      const std::uint32_t next = i + 1 < leaf.count ? spare++ : 0;
      records_[record] = makeLeaf_(binary_.order[leaf.first + i], next);
      record = next;
    }
    return spare;
  }

  const BinaryTree& binary_;
  const WideTree& wide_;
  MakeLeaf makeLeaf_;
  std::span<BvhRecord> records_;
};

template <class MakeLeaf>
LargeVector<BvhRecord> encodeTree(const BinaryTree& binary, const WideTree& wide, MakeLeaf makeLeaf) {
  const std::uint32_t count = 1 + (wide.isLeaf(0) ? binary.nodes[0].count : wide.recordsBelow(0));
  checkBvhSize(count);
  LargeVector<BvhRecord> records(count);
  Encoder(binary, wide, makeLeaf, records).encode(0, 0, 1);
  return records;
}

}  // namespace

BvhRecord makeBvhTriangle(const std::array<vec3, 3>& vertices, std::uint32_t triangle, std::uint32_t next) {
  std::uint32_t turn = 0;
  float longest = -1.0f;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const float edge = squaredLength(vertices[(i + 2) % 3] - vertices[(i + 1) % 3]);
    if (edge <= longest) continue;
    longest = edge;
    turn = i;
  }
  const BvhTriangle record{vertices[turn],           triangle,       vertices[(turn + 1) % 3], next,
                           vertices[(turn + 2) % 3], kBvhLeaf | turn};
  return std::bit_cast<BvhRecord>(record);
}

BvhRecord makeBvhNode(std::span<const Box> children, std::uint32_t firstChild) {
  BvhNode node{};
  node.firstChild = firstChild;
  node.kind = kBvhInner;
  Box whole = children.empty() ? Box{Float4{}, Float4{}} : Box::empty();
  for (const Box& child : children) whole.include(child);
  const std::array<std::uint32_t*, 3> lows{&node.lowX, &node.lowY, &node.lowZ};
  const std::array<std::uint32_t*, 3> highs{&node.highX, &node.highY, &node.highZ};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const Grid grid = makeGrid(whole.lo[axis], whole.hi[axis]);
    node.gridOrigin[axis] = grid.origin;
    node.gridExponents |= static_cast<std::uint32_t>(grid.exponent + kExponentBias) << (8 * axis);
    for (std::uint32_t slot = 0; slot < kBvhWidth; ++slot) {
      const bool isUsed = slot < children.size();
      const int low = isUsed ? grid.below(children[slot].lo[axis]) : kLastStep;
      const int high = isUsed ? grid.above(children[slot].hi[axis]) : 0;
      *lows[a] |= static_cast<std::uint32_t>(low) << (8 * slot);
      *highs[a] |= static_cast<std::uint32_t>(high) << (8 * slot);
    }
  }
  return std::bit_cast<BvhRecord>(node);
}

Box childBox(const BvhNode& node, std::uint32_t slot) {
  const std::array<std::uint32_t, 3> lows{node.lowX, node.lowY, node.lowZ}, highs{node.highX, node.highY, node.highZ};
  Box box = Box::empty();
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const int exponent = static_cast<int>((node.gridExponents >> (8 * axis)) & 255u) - kExponentBias;
    const auto plane = [&](std::uint32_t word) {
      return node.gridOrigin[axis] + std::ldexp(static_cast<float>((word >> (8 * slot)) & 255u), exponent);
    };
    box.lo[axis] = plane(lows[a]);
    box.hi[axis] = plane(highs[a]);
  }
  return box;
}

bool hasChild(const BvhNode& node, std::uint32_t slot) {
  return ((node.lowX >> (8 * slot)) & 255u) <= ((node.highX >> (8 * slot)) & 255u);
}

void checkBvhSize(std::size_t records) {
  if (records < 1u << kBvhIndexBits) return;
  throw SceneError("too many triangles", "",
                   fmt::format("use fewer than {} million", (1u << kBvhIndexBits) * 3 / 4 / 1000000));
}

LargeVector<BvhRecord> encodeBvh(const BinaryTree& binary, const WideTree& wide, std::span<const vec3> positions,
                                 std::span<const Triangle> triangles) {
  return encodeTree(binary, wide, [&](std::uint32_t triangle, std::uint32_t next) {
    const Triangle& t = triangles[triangle];
    return makeBvhTriangle({positions[t.v0], positions[t.v1], positions[t.v2]}, triangle, next);
  });
}

LargeVector<BvhRecord> encodeBvh(const BinaryTree& binary, const WideTree& wide,
                                 std::span<const BvhRecord> primitives) {
  return encodeTree(binary, wide, [&](std::uint32_t primitive, std::uint32_t) { return primitives[primitive]; });
}

}  // namespace importon
