/// A bounding volume hierarchy over triangles, built on the CPU, in the compact layout that the traversal
/// kernel reads (shaders/shared/bvh_data.h).
#pragma once
#include <functional>
#include <span>
#include <vector>

#include "shared/bvh_data.h"
#include "shared/scene_data.h"

namespace importon {

struct BvhOptions {
  int threads = 0;  // 0: all
  std::function<void(double fraction)> progress;  // called now and then from one thread; may be empty
};

/// Nodes and triangles in traversal order.
struct Bvh {
  std::vector<BvhNode> nodes;          // root first; never empty
  std::vector<BvhTriangle> triangles;  // grouped by leaf; each knows its index in Scene::triangles
};

/// Builds over all triangles; those without area must have been dropped. Deterministic whatever the number
/// of threads. Positions must be finite.
[[nodiscard]] Bvh buildBvh(std::span<const vec3> positions, std::span<const Triangle> triangles,
                           const BvhOptions& options = {});

}  // namespace importon
