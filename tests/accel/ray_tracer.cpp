#include "accel/ray_tracer.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "render/device/kernel_variants.h"
#include "render/device_scene/instances.h"
#include "shared/features.h"

namespace importon::test {
namespace {

constexpr std::size_t kCounters = 64;

}  // namespace

RayTracer::RayTracer(gpu::Context& context, const Bvh& bvh) : RayTracer(context, bvh, false) {
  scene_.bvh = gpu::makeBuffer<BvhRecord>(context, "BVH", bvh.nodes, gpu::TexelFormat::uint4);
  scene_.tables = gpu::makeBuffer<uvec4>(context, "tables", packInstances({}, {}), gpu::TexelFormat::uint4);
}

RayTracer::RayTracer(gpu::Context& context, const Bvh& bvh, const Scene& scene) : RayTracer(context, bvh, true) {
  scene_ = uploadScene(context, scene, bvh);
}

RayTracer::RayTracer(gpu::Context& context, const Bvh& bvh, bool hasAlpha)
    : context_(context),
      invocations_(context.limits().isCpu ? 1u << 11 : 1u << 18),
      kernels_(context,
               {{kSpecTraceInvocations, static_cast<std::uint32_t>(invocations_)},
                {kSpecHasInstances, bvh.meshRoots.empty() ? 0u : 1u}},
               hasAlpha),
      counters_(gpu::makeBuffer<std::uint32_t>(context, "counters", std::vector<std::uint32_t>(kCounters, 0))) {}

void RayTracer::upload(std::span<const Ray> rays) {
  count_ = rays.size();
  std::vector<std::uint32_t> queue(count_);
  std::iota(queue.begin(), queue.end(), 0u);
  rays_ = gpu::makeBuffer(context_, "rays", rays, gpu::TexelFormat::uint4);
  hits_ = gpu::Buffer(context_, "hits", count_ * sizeof(Hit));
  queue_ = gpu::makeBuffer<std::uint32_t>(context_, "queue", queue);
  const auto length = static_cast<std::uint32_t>(count_);
  counters_.upload(std::span(&length, 1));
}

void RayTracer::trace(bool isAnyHit) {
  gpu::Recorder recorder(context_);
  const std::size_t count = std::max((count_ + 31) / 32, std::min(count_, invocations_));
  const struct { const gpu::Buffer &counters, &rays, &hits, &queue; } own{counters_, rays_, hits_, queue_};
  const auto dispatch = [&]<class Call>(Call) {
    recorder.dispatch(kernels_.get<Call>(), Call::buffers(own, scene_), count, typename Call::Push{0});
  };
  if (kernels_.hasAlpha())
    isAnyHit ? dispatch(kernels::TraceShadowAlpha{}) : dispatch(kernels::TraceClosestAlpha{});
  else
    isAnyHit ? dispatch(kernels::TraceShadow{}) : dispatch(kernels::TraceClosest{});
  recorder.submitAndWait();
  seconds_ = recorder.times().front().milliseconds * 1e-3;
}

std::vector<Hit> RayTracer::hits() const { return hits_.download<Hit>(count_); }

std::uint32_t RayTracer::unfinished() const {
  return counters_.download<std::uint32_t>(kCounters)[kCounterTraceUnfinished];
}

std::vector<Hit> RayTracer::closestHits(std::span<const Ray> rays) {
  upload(rays);
  trace(false);
  return hits();
}

std::vector<Hit> RayTracer::anyHits(std::span<const Ray> rays) {
  upload(rays);
  trace(true);
  return hits();
}

}  // namespace importon::test
