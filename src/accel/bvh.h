/// A bounding volume hierarchy over triangles, built on the CPU, in the compact layout that the traversal
/// kernel reads (shaders/shared/bvh_data.h).
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/large_vector.h"
#include "shared/bvh_data.h"
#include "shared/scene_data.h"

namespace importon {

struct BvhOptions {
  int threads = 0;                                       // 0: all
  std::function<void(double fraction)> progress;         // called now and then from the calling thread; may be empty
  bool splits = true;                                    // long diagonal triangles are cut where that pays
  std::uint32_t mostDepth = kBvhMaxDepth;                // nodes on a path, at least 32
  std::function<bool(const Triangle&)> staysWhole = {};  // true of those that stand in one leaf alone; empty: none need
};

/// A BvhNode or a BvhTriangle: 48 bytes, three texels.
using BvhRecord = std::array<std::uint32_t, 12>;
static_assert(sizeof(BvhNode) == sizeof(BvhRecord) && sizeof(BvhTriangle) == sizeof(BvhRecord));

[[nodiscard]] inline bool isLeaf(const BvhRecord& record) { return (record[11] & kBvhLeaf) != 0; }
[[nodiscard]] inline BvhNode asNode(const BvhRecord& record) { return std::bit_cast<BvhNode>(record); }
[[nodiscard]] inline BvhTriangle asTriangle(const BvhRecord& record) { return std::bit_cast<BvhTriangle>(record); }

struct Bvh {
  LargeVector<BvhRecord> nodes;          // nodes and triangles alike; the root first
  std::uint32_t depth = 0;               // nodes on the longest path
  std::vector<std::uint32_t> meshRoots;  // of placed meshes: two_level.h
};

/// Builds over all triangles; those without area must have been dropped. Positions must be finite.
/// A triangle may be in several leaves (splitTriangles); the traversal finds the same hits.
/// Deterministic whatever the number of threads. Where more than a few dozen triangles have the very same
/// vertices, only the one with the smallest index is kept there. Throws SceneError when there are more
/// triangles than record indices allow (about 12 million).
[[nodiscard]] Bvh buildBvh(std::span<const vec3> positions, std::span<const Triangle> triangles,
                           const BvhOptions& options = {});

}  // namespace importon
