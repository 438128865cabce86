/// The scene and its BVH in device memory.
#pragma once
#include "accel/bvh.h"
#include "gpu/buffer.h"
#include "gpu/kernel.h"
#include "scene/scene.h"
#include "shared/render_data.h"

namespace importon {

/// By the names that kernels have for its buffers.
struct DeviceScene {
  gpu::Buffer bvh, vertices, triangles, images, lightAlias, environment, environmentDraw;
  gpu::Buffer starts, tables, lists;  // shaders/bindings/tables.glsl
  double area = 0;                    // m², of one side of all surfaces
};

/// Uploads; throws DeviceError with need and limit if the device cannot hold it.
[[nodiscard]] DeviceScene uploadScene(gpu::Context& context, const Scene& scene, const Bvh& bvh);

/// Alias table over `weights` (at least one, none negative, a positive sum). [Vose 1991]
[[nodiscard]] std::vector<LightAlias> makeAliasTable(const std::vector<double>& weights);

}  // namespace importon
