#include "accel/bvh.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "accel/binary_tree.h"
#include "accel/build_progress.h"
#include "accel/coincident.h"
#include "accel/encode.h"
#include "accel/split_triangles.h"
#include "accel/tree_top.h"
#include "accel/wide_tree.h"
#include "base/parallel.h"

namespace importon {
namespace {

constexpr std::uint32_t kMaxCoincident = 64;  // triangles in one place that are all kept

/// Of the triangles `chosen`, or of all.
LargeVector<PrimitiveBox> makeBoxes(std::span<const vec3> positions, std::span<const Triangle> triangles,
                                    std::span<const std::uint32_t> chosen) {
  constexpr std::size_t kChunk = 4096;
  LargeVector<PrimitiveBox> boxes(chosen.empty() ? triangles.size() : chosen.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, boxes.size(), kChunk),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        const std::uint32_t index = chosen.empty() ? static_cast<std::uint32_t>(i) : chosen[i];
                        const Triangle& triangle = triangles[index];
                        Box box = Box::empty();
                        box.include(toFloat4(positions[triangle.v0]));
                        box.include(toFloat4(positions[triangle.v1]));
                        box.include(toFloat4(positions[triangle.v2]));
                        setPrimitiveIndex(box, index);
                        boxes[i] = box;
                      }
                    });
  return boxes;
}

Bvh encode(const BinaryTree& binary, const WideTree& wide, std::span<const vec3> positions,
           std::span<const Triangle> triangles) {
  return {encodeBvh(binary, wide, positions, triangles), wide.depth(), {}};
}

/// Decides on the top of the tree again, if paths don't become too long by that.
Bvh encodeImproved(BinaryTree& binary, std::span<const vec3> positions, std::span<const Triangle> triangles) {
  const WideTreeOptions options{.listsLeavesFirst = true};
  TreeTop top(binary, {});
  top.improve();
  {
    const WideTree wide(binary, options);
    if (wide.depth() <= kBvhMaxDepth) return encode(binary, wide, positions, triangles);
  }
  top.undo();
  return encode(binary, WideTree(binary, options), positions, triangles);
}

Bvh build(std::span<const vec3> positions, std::span<const Triangle> triangles, const BvhOptions& asked,
          const BinaryTreeOptions& options, BuildProgress& progress) {
  if (triangles.empty()) return {{makeBvhNode({}, 0)}, 1, {}};
  bool isCut = false;
  const auto buildOver = [&](std::span<const std::uint32_t> chosen) {
    LargeVector<PrimitiveBox> boxes = makeBoxes(positions, triangles, chosen);
    const std::size_t whole = boxes.size();
    if (asked.splits) boxes = splitTriangles(std::move(boxes), positions, triangles, {}, asked.staysWhole);
    isCut = boxes.size() > whole;
    return buildBinaryTree(std::move(boxes), options, progress);
  };
  BinaryTree binary = buildOver({});
  if (binary.coincident > kMaxCoincident) binary = buildOver(distinctTriangles(positions, triangles));
  // Among triangles along the axes it brings less than it costs shadow rays (docs/experiments/trees.md).
  if (isCut) return encodeImproved(binary, positions, triangles);
  return encode(binary, WideTree(binary, {}), positions, triangles);
}

}  // namespace

Bvh buildBvh(std::span<const vec3> positions, std::span<const Triangle> triangles, const BvhOptions& options) {
  BuildProgress progress(options.progress, triangles.size());
  Bvh bvh;
  tbb::task_arena arena(threadCount(options.threads));
  arena.execute([&] {
    bvh = build(positions, triangles, options, {}, progress);
    if (bvh.depth <= options.mostDepth) return;
    // A part of a triangle is a primitive, too: there are at most twice as many.
    const auto bits = static_cast<std::uint32_t>(std::bit_width(2 * triangles.size()));
    const std::uint32_t sahDepth = options.mostDepth > bits + 1 ? options.mostDepth - bits - 1 : 0;
    bvh = build(positions, triangles, options, {.sahDepth = sahDepth}, progress);
  });
  progress.finish();
  return bvh;
}

}  // namespace importon
