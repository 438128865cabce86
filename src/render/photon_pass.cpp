#include "render/photon_pass.h"

#include <utility>

#include "shared/bindings.h"
#include "shared/push_data.h"

namespace importon {

void tracePhotons(const Stage& stage, std::uint32_t first, std::uint32_t count, uint maxDepth) {
  gpu::BindingTable table = stage.work.table;
  const gpu::Buffer *now = &stage.work.queueA, *next = &stage.work.queueB;
  uint counter = kCounterQueueA, nextCounter = kCounterQueueB;
  table.set(kBindingQueue, *now);
  setCounter(stage, kCounterRecords, 0);
  setCounter(stage, counter, count);
  stage.recorder.dispatch(stage.kernels.photonEmit, table, count, PhotonEmitPush{first, count});
  for (uint depth = 0; depth <= maxDepth; ++depth) {
    table.set(kBindingQueue, *now);
    overRays(stage, stage.kernels.traceClosest, table, counter, TracePush{counter});
    overItems(stage, stage.kernels.photonScatter, table, counter, PhotonScatterPush{counter});
    compact(stage, counter, nextCounter, now, *next, kCounterRecords);
    std::swap(now, next);
    std::swap(counter, nextCounter);
  }
  setCounter(stage, kCounterRaysClosest, 0, kCounterRaysClosest, kCounterRecords);
}

}  // namespace importon
