/// Placed meshes as kernels read them, and the tree of the scene.
#pragma once
#include <span>
#include <vector>

#include "accel/bvh.h"
#include "scene/scene.h"

namespace importon {

/// The tree of all triangles, or, with placed meshes, of two levels.
[[nodiscard]] Bvh buildSceneTree(const Scene& scene, BvhOptions options);

/// InstanceData as texels: the world, then the instances. `roots`: of the meshes' trees. At least the world.
[[nodiscard]] std::vector<uvec4> packInstances(const PlacedMeshes& placed, std::span<const std::uint32_t> roots);

/// Number among those of the instance that each page is of.
[[nodiscard]] std::vector<uint> instancesOfPages(const PlacedMeshes& placed);

}  // namespace importon
