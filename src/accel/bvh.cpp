#include "accel/bvh.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "accel/binary_tree.h"
#include "accel/build_progress.h"
#include "accel/coincident.h"
#include "accel/encode.h"
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

LargeVector<BvhRecord> build(std::span<const vec3> positions, std::span<const Triangle> triangles,
                             BuildProgress& progress) {
  if (triangles.empty()) return {makeBvhNode({}, 0)};
  BinaryTree binary = buildBinaryTree(makeBoxes(positions, triangles, {}), {}, progress);
  if (binary.coincident > kMaxCoincident)
    binary =
        buildBinaryTree(makeBoxes(positions, triangles, distinctTriangles(positions, triangles)), {}, progress);
  return encodeBvh(binary, WideTree(binary, {}), positions, triangles);
}

}  // namespace

Bvh buildBvh(std::span<const vec3> positions, std::span<const Triangle> triangles, const BvhOptions& options) {
  BuildProgress progress(options.progress, triangles.size());
  Bvh bvh;
  tbb::task_arena arena(threadCount(options.threads));
  arena.execute([&] { bvh.nodes = build(positions, triangles, progress); });
  progress.finish();
  return bvh;
}

}  // namespace importon
