#include "accel/ray_tracer.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "kernels/registry.h"
#include "shared/bindings.h"
#include "shared/features.h"
#include "shared/push_data.h"

namespace importon::test {
namespace {

constexpr std::size_t kCounters = 64;

gpu::Kernel makeKernel(gpu::Context& context, const char* module, bool isAnyHit, std::size_t invocations) {
  const std::array<gpu::Specialization, 2> constants{
      {{kSpecAnyHit, isAnyHit ? 1u : 0u}, {kSpecTraceInvocations, static_cast<std::uint32_t>(invocations)}}};
  return gpu::Kernel(context, isAnyHit ? "trace any" : "trace closest", kernels::spirv(module), constants);
}

}  // namespace

RayTracer::RayTracer(gpu::Context& context, const Bvh& bvh) : RayTracer(context, bvh, "trace") {}

RayTracer::RayTracer(gpu::Context& context, const Bvh& bvh, const Scene& scene)
    : RayTracer(context, bvh, "trace_alpha") {
  scene_ = uploadScene(context, scene, bvh);
  scene_.bind(bindings_);
}

RayTracer::RayTracer(gpu::Context& context, const Bvh& bvh, const char* module)
    : context_(context),
      invocations_(context.limits().isCpu ? 1u << 11 : 1u << 18),
      closest_(makeKernel(context, module, false, invocations_)),
      any_(makeKernel(context, module, true, invocations_)),
      bvh_(gpu::makeBuffer<BvhRecord>(context, "BVH", bvh.nodes, gpu::TexelFormat::uint4)),
      counters_(gpu::makeBuffer<std::uint32_t>(context, "counters", std::vector<std::uint32_t>(kCounters, 0))) {
  bindings_.set(kBindingBvhNodes, bvh_);
  bindings_.set(kBindingCounters, counters_);
}

void RayTracer::upload(std::span<const Ray> rays) {
  count_ = rays.size();
  std::vector<std::uint32_t> queue(count_);
  std::iota(queue.begin(), queue.end(), 0u);
  rays_ = gpu::makeBuffer(context_, "rays", rays, gpu::TexelFormat::uint4);
  hits_ = gpu::Buffer(context_, "hits", count_ * sizeof(Hit));
  queue_ = gpu::makeBuffer<std::uint32_t>(context_, "queue", queue);
  bindings_.set(kBindingRayTexels, rays_);
  bindings_.set(kBindingHits, hits_);
  bindings_.set(kBindingQueue, queue_);
  const auto length = static_cast<std::uint32_t>(count_);
  counters_.upload(std::span(&length, 1));
}

void RayTracer::trace(bool isAnyHit) {
  gpu::Recorder recorder(context_);
  recorder.dispatch(isAnyHit ? any_ : closest_, bindings_, std::max((count_ + 31) / 32, std::min(count_, invocations_)),
                    TracePush{0});
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
