/// Traces rays through kernels/traversal/trace.comp, for tests and benchmarks.
#pragma once
#include <span>
#include <vector>

#include "accel/bvh.h"
#include "gpu/buffer.h"
#include "gpu/recorder.h"
#include "render/device/kernel_set.h"
#include "render/device_scene/device_scene.h"
#include "scene/scene.h"
#include "shared/ray_data.h"

namespace importon::test {

/// A BVH on the device with the kernels that trace through it.
class RayTracer {
 public:
  /// Nothing has alpha.
  RayTracer(gpu::Context& context, const Bvh& bvh);
  /// Through kernels/traversal/trace_alpha.comp: rays pass where the materials of `scene` have holes.
  RayTracer(gpu::Context& context, const Bvh& bvh, const Scene& scene);

  /// Sets the rays of the following calls.
  void upload(std::span<const Ray> rays);
  void trace(bool isAnyHit);
  /// By ray, of the last trace.
  [[nodiscard]] std::vector<Hit> hits() const;
  /// Seconds of device time of the last trace.
  [[nodiscard]] double seconds() const { return seconds_; }
  /// Rays given up so far; 0 if all went well.
  [[nodiscard]] std::uint32_t unfinished() const;

  [[nodiscard]] std::vector<Hit> closestHits(std::span<const Ray> rays);
  [[nodiscard]] std::vector<Hit> anyHits(std::span<const Ray> rays);

 private:
  RayTracer(gpu::Context& context, const Bvh& bvh, bool hasAlpha);

  gpu::Context& context_;
  std::size_t invocations_;  // that a short queue is spread over
  KernelSet kernels_;
  DeviceScene scene_;
  gpu::Buffer counters_, rays_, hits_, queue_;
  std::size_t count_ = 0;
  double seconds_ = 0;
};

}  // namespace importon::test
