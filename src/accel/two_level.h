/// A tree above trees: each mesh has its own, and one more has them all as leaves, each as often as the mesh is placed.
#pragma once
#include <span>
#include <vector>

#include "accel/box.h"
#include "accel/bvh.h"

namespace importon {

struct PlacedTrees {
  struct Mesh {
    std::uint32_t firstTriangle;  // in the scene
    std::span<const Triangle> triangles;
  };
  std::span<const vec3> positions;
  std::span<const Triangle> world;  // triangles that are not placed; the scene's first ones
  std::vector<Mesh> meshes;
  std::vector<Box>
      instances;  // boxes in render space, with room for rounding; instance i is number i + 1 in its record
};

/// The tree of the world, cut open into some of its larger parts, and of all instances; then those of the meshes, in
/// object space, whose roots meshRoots tells. A ray may be in a mesh's tree below the other: paths through both are no
/// longer than kBvhMaxDepth together. Deterministic. Throws as buildBvh does.
[[nodiscard]] Bvh buildTwoLevelBvh(const PlacedTrees& trees, const BvhOptions& options = {});

}  // namespace importon
