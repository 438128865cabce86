#include "accel/bvh.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <memory>
#include <numeric>

#include "accel/binary_tree.h"
#include "accel/build_progress.h"
#include "accel/coincident.h"
#include "accel/encode.h"
#include "accel/wide_tree.h"
#include "base/parallel.h"

namespace importon {
namespace {

constexpr std::uint32_t kMaxCoincident = 64;  // triangles in one place that are all kept

std::unique_ptr<PrimitiveBox[]> makeBoxes(std::span<const vec3> positions, std::span<const Triangle> triangles,
                                          std::span<const std::uint32_t> chosen) {
  constexpr std::size_t kChunk = 4096;
  auto boxes = std::make_unique_for_overwrite<PrimitiveBox[]>(chosen.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, chosen.size(), kChunk),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        const Triangle& triangle = triangles[chosen[i]];
                        Box box = Box::empty();
                        box.include(toFloat4(positions[triangle.v0]));
                        box.include(toFloat4(positions[triangle.v1]));
                        box.include(toFloat4(positions[triangle.v2]));
                        setPrimitiveIndex(box, chosen[i]);
                        boxes[i] = box;
                      }
                    });
  return boxes;
}

std::vector<BvhRecord> build(std::span<const vec3> positions, std::span<const Triangle> triangles,
                             BuildProgress& progress) {
  if (triangles.empty()) return {makeBvhNode({}, 0)};
  std::vector<std::uint32_t> chosen(triangles.size());
  std::iota(chosen.begin(), chosen.end(), 0u);
  std::unique_ptr<PrimitiveBox[]> boxes = makeBoxes(positions, triangles, chosen);
  BinaryTree binary = buildBinaryTree({boxes.get(), chosen.size()}, {}, progress);
  if (binary.coincident > kMaxCoincident) {
    chosen = distinctTriangles(positions, triangles);
    boxes = makeBoxes(positions, triangles, chosen);
    binary = buildBinaryTree({boxes.get(), chosen.size()}, {}, progress);
  }
  boxes.reset();
  return encodeBvh(binary, buildWideTree(binary, {}), positions, triangles);
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
