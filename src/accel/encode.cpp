#include "accel/encode.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

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

/// Where the records of the children and the chained triangles of each wide node go.
struct Places {
  std::vector<std::uint32_t> node;        // record of each wide node
  std::vector<std::uint32_t> firstChild;  // of each wide node
  std::uint32_t count = 1;                // records in all; the root is record 0
};

Places placeRecords(const BinaryTree& binary, const std::vector<WideNode>& wide) {
  Places places{std::vector<std::uint32_t>(wide.size(), 0), std::vector<std::uint32_t>(wide.size(), 0), 1};
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty()) {
    const std::uint32_t index = stack.back();
    stack.pop_back();
    const WideNode& node = wide[index];
    places.firstChild[index] = places.count;
    places.count += node.childCount;
    for (std::uint32_t slot = node.childCount; slot-- > 0;) {
      const WideNode::Child& child = node.children[slot];
      if (child.wideNode == WideNode::kLeaf) {
        places.count += binary.nodes[child.binaryNode].count - 1;
      } else {
        places.node[child.wideNode] = places.firstChild[index] + slot;
        stack.push_back(child.wideNode);
      }
    }
    if (places.count >= 1u << kBvhIndexBits)
      throw SceneError("too many triangles", "",
                       fmt::format("use fewer than {} million", (1u << kBvhIndexBits) * 3 / 4 / 1000000));
  }
  return places;
}

class Encoder {
 public:
  Encoder(const BinaryTree& binary, const std::vector<WideNode>& wide, const Places& places,
          std::span<const vec3> positions, std::span<const Triangle> triangles, std::vector<BvhRecord>& records)
      : binary_(binary),
        wide_(wide),
        places_(places),
        positions_(positions),
        triangles_(triangles),
        records_(records) {}

  /// The node itself and the triangles of its leaves.
  void encode(std::uint32_t index) const {
    const WideNode& node = wide_[index];
    const std::uint32_t firstChild = places_.firstChild[index];
    std::array<Box, kBvhWidth> boxes;
    std::uint32_t spare = firstChild + node.childCount;
    for (std::uint32_t slot = 0; slot < node.childCount; ++slot) {
      const WideNode::Child& child = node.children[slot];
      const BinaryNode& box = binary_.nodes[child.binaryNode];
      boxes[slot] = {Float4{box.lo[0], box.lo[1], box.lo[2], 0.0f},
                     Float4{box.hi[0], box.hi[1], box.hi[2], 0.0f}};
      if (child.wideNode == WideNode::kLeaf) spare = encodeLeaf(box, firstChild + slot, spare);
    }
    records_[places_.node[index]] = makeBvhNode(std::span(boxes).first(node.childCount), firstChild);
  }

 private:
  /// Its first triangle is record `record`, the rest from `spare` on. Returns what is spare then.
  std::uint32_t encodeLeaf(const BinaryNode& leaf, std::uint32_t record, std::uint32_t spare) const {
    for (std::uint32_t i = 0; i < leaf.count; ++i) {
      const std::uint32_t triangle = binary_.order[leaf.first + i];
      const Triangle& indices = triangles_[triangle];
      const std::uint32_t next = i + 1 < leaf.count ? spare++ : 0;
      records_[record] = makeBvhTriangle(
          {positions_[indices.v0], positions_[indices.v1], positions_[indices.v2]}, triangle, next);
      record = next;
    }
    return spare;
  }

  const BinaryTree& binary_;
  const std::vector<WideNode>& wide_;
  const Places& places_;
  std::span<const vec3> positions_;
  std::span<const Triangle> triangles_;
  std::vector<BvhRecord>& records_;
};

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
  const std::array<std::uint32_t, 3> lows{node.lowX, node.lowY, node.lowZ},
      highs{node.highX, node.highY, node.highZ};
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

std::vector<BvhRecord> encodeBvh(const BinaryTree& binary, const std::vector<WideNode>& wide,
                                 std::span<const vec3> positions, std::span<const Triangle> triangles) {
  constexpr std::size_t kChunk = 1024;
  const Places places = placeRecords(binary, wide);
  std::vector<BvhRecord> records(places.count);
  const Encoder encoder(binary, wide, places, positions, triangles, records);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, wide.size(), kChunk),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i)
                        encoder.encode(static_cast<std::uint32_t>(i));
                    });
  return records;
}

}  // namespace importon
