#include "accel/split_triangles.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <bit>
#include <utility>
#include <vector>

#include "accel/clip.h"

namespace importon {
namespace {

constexpr std::size_t kChunk = 4096;  // boxes looked at by one task; a fixed number, as sums depend on it
constexpr std::size_t kMostParts = (std::size_t{1} << kBvhIndexBits) / 4 * 3;  // for which records have indices
constexpr float kWasteFactor = 3.0f;                                           // see SplitOptions
/// Edges of triangles are hit within rounding, so parts stand off them, in units of the scene's largest
/// coordinate.
constexpr float kMargin = 1.0f / (1 << 22);
constexpr std::uint32_t kGone = 0xFFFFFFFFu;  // place of a part that has been cut itself

/// The coarsest of the planes at multiples of 2^-i of the scene's box that cuts a box within, or its middle.
float cutPlane(const Box& scene, const Box& box, int axis) {
  constexpr float kCells = 1 << 20;
  const float origin = scene.lo[axis], extent = scene.hi[axis] - origin;
  const auto cell = [&](float x) { return static_cast<std::uint32_t>((x - origin) / extent * kCells); };
  const std::uint32_t low = cell(box.lo[axis]), high = cell(box.hi[axis]);
  if (low != high) {
    const int bit = std::bit_width(low ^ high) - 1;
    const float plane = origin + static_cast<float>(high >> bit << bit) * (extent / kCells);
    if (plane > box.lo[axis] && plane < box.hi[axis]) return plane;
  }
  return 0.5f * box.lo[axis] + 0.5f * box.hi[axis];
}

struct Sums {
  Box scene = Box::empty();
  double area = 0;  // of all boxes
};

Sums sumUp(std::span<const Box> boxes) {
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, boxes.size(), kChunk), Sums(),
      [&](const tbb::blocked_range<std::size_t>& range, Sums sums) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          sums.scene.include(boxes[i]);
          sums.area += static_cast<double>(boxes[i].halfArea());
        }
        return sums;
      },
      [](Sums a, const Sums& b) {
        a.scene.include(b.scene);
        a.area += b.area;
        return a;
      });
}

/// Indices of the boxes of more than this area.
std::vector<std::uint32_t> largerThan(float area, std::span<const Box> boxes) {
  std::vector<std::vector<std::uint32_t>> chunks((boxes.size() + kChunk - 1) / kChunk);
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t chunk) {
    const std::size_t end = std::min(boxes.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i)
      if (boxes[i].halfArea() > area) chunks[chunk].push_back(static_cast<std::uint32_t>(i));
  });
  std::vector<std::uint32_t> all;
  for (const std::vector<std::uint32_t>& chunk : chunks) all.insert(all.end(), chunk.begin(), chunk.end());
  return all;
}

/// Cuts the box of most waste, again and again.
class Splitter {
 public:
  Splitter(const Box& scene, std::span<const vec3> positions, std::span<const Triangle> triangles,
           const SplitOptions& options)
      : scene_(scene),
        positions_(positions),
        triangles_(triangles),
        leastWaste_(options.leastWaste * scene.halfArea()),
        leastGain_(options.leastGain) {}

  /// Takes over the box of a whole triangle, which `place` stands for.
  void add(const PrimitiveBox& box, std::uint32_t place) { push({box, place}); }
  /// Makes at most `most` cuts.
  void split(std::size_t most) {
    while (most > 0 && !queue_.empty()) {
      std::pop_heap(queue_.begin(), queue_.end());
      const std::uint32_t part = queue_.back().second;
      queue_.pop_back();
      if (cut(part)) --most;
    }
  }
  /// Boxes of enough waste to be cut.
  [[nodiscard]] std::size_t waiting() const { return queue_.size(); }
  [[nodiscard]] double saved() const { return saved_; }
  void replace(LargeVector<PrimitiveBox>& boxes) const;

 private:
  struct Part {
    PrimitiveBox box;
    std::uint32_t place;
    bool isCut = false;
  };

  [[nodiscard]] ClippedTriangle clip(const Part& part) const;
  void push(const Part& part);
  bool cut(std::uint32_t index);

  const Box scene_;
  std::span<const vec3> positions_;
  std::span<const Triangle> triangles_;
  float leastWaste_, leastGain_;
  double saved_ = 0;
  std::size_t cuts_ = 0;
  std::vector<Part> parts_;
  std::vector<std::pair<float, std::uint32_t>> queue_;  // waste, part
};

ClippedTriangle Splitter::clip(const Part& part) const {
  const Triangle& t = triangles_[primitiveIndex(part.box)];
  ClippedTriangle polygon(positions_[t.v0], positions_[t.v1], positions_[t.v2]);
  if (!part.isCut) return polygon;
  for (int axis = 0; axis < 3; ++axis)
    polygon = polygon.cut(axis, part.box.lo[axis]).second.cut(axis, part.box.hi[axis]).first;
  return polygon;
}

void Splitter::push(const Part& part) {
  const float waste = part.box.halfArea() - kWasteFactor * clip(part).projectedArea();
  parts_.push_back(part);
  if (!(waste > leastWaste_)) return;
  queue_.emplace_back(waste, static_cast<std::uint32_t>(parts_.size() - 1));
  std::push_heap(queue_.begin(), queue_.end());
}

/// In two at a plane across its longest side. The lower part takes its place. False if that saves little.
bool Splitter::cut(std::uint32_t index) {
  Part lower = parts_[index];
  const Box box = lower.box;
  const Float4 size = box.hi - box.lo;
  const int axis = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
  const float plane = cutPlane(scene_, box, axis);
  if (!(plane > box.lo[axis] && plane < box.hi[axis])) return false;
  const auto [below, above] = clip(lower).cut(axis, plane);
  if (below.isEmpty() || above.isEmpty()) return false;
  Part upper = lower;
  lower.box = below.box(box);
  upper.box = above.box(box);
  const float gain = box.halfArea() - lower.box.halfArea() - upper.box.halfArea();
  if (!(gain >= leastGain_ * box.halfArea())) return false;
  saved_ += static_cast<double>(gain);
  ++cuts_;
  for (Part* part : {&lower, &upper}) {
    part->isCut = true;
    setPrimitiveIndex(part->box, primitiveIndex(box));
    push(*part);
  }
  parts_[index].place = kGone;
  return true;
}

/// The first part of a triangle takes the place of its box, the others go to the end.
void Splitter::replace(LargeVector<PrimitiveBox>& boxes) const {
  const Float4 reach = max4(scene_.hi, -scene_.lo);
  const float margin = kMargin * std::max({reach[0], reach[1], reach[2]});
  std::vector<bool> isTaken(boxes.size(), false);
  boxes.reserve(boxes.size() + cuts_);
  for (const Part& part : parts_) {
    if (part.place == kGone || !part.isCut) continue;
    PrimitiveBox box{part.box.lo - margin, part.box.hi + margin};
    setPrimitiveIndex(box, primitiveIndex(part.box));
    if (isTaken[part.place])
      boxes.push_back(box);
    else
      boxes[part.place] = box;
    isTaken[part.place] = true;
  }
}

}  // namespace

LargeVector<PrimitiveBox> splitTriangles(LargeVector<PrimitiveBox> boxes, std::span<const vec3> positions,
                                         std::span<const Triangle> triangles, const SplitOptions& options,
                                         const std::function<bool(const Triangle&)>& staysWhole) {
  const Sums sums = sumUp(boxes);
  const std::size_t room = kMostParts - std::min(kMostParts, boxes.size());
  const std::size_t most = std::min(
      room, static_cast<std::size_t>(static_cast<double>(options.mostParts) * static_cast<double>(boxes.size())));
  Splitter splitter(sums.scene, positions, triangles, options);
  for (const std::uint32_t index : largerThan(options.leastWaste * sums.scene.halfArea(), boxes)) {
    if (staysWhole && staysWhole(triangles[primitiveIndex(boxes[index])])) continue;
    splitter.add(boxes[index], index);
    if (splitter.waiting() > most) return boxes;
  }
  splitter.split(most);
  if (splitter.saved() > 0 && splitter.saved() >= static_cast<double>(options.leastGainInAll) * sums.area)
    splitter.replace(boxes);
  return boxes;
}

}  // namespace importon
