#include "render/photon_pass.h"

#include <utility>

#include "shared/bindings.h"
#include "shared/push_data.h"

namespace importon {

void tracePhotons(const Stage& stage, const PhotonSource& source, std::uint32_t first, std::uint32_t count,
                  uint maxDepth) {
  const KernelSet& kernels = stage.kernels;
  const bool isGlobal = source.kind == MapKind::global, isGuided = source.guide != nullptr;
  const uint plain = isGlobal ? kStreamGlobalPhotons : kStreamCausticPhotons;
  const uint stream = (isGuided ? source.guide->stream() : plain) + (source.isPilot ? kStreamPilot : 0);
  gpu::BindingTable table = stage.work.table;
  if (isGuided) source.guide->bind(table);
  const gpu::Buffer *now = &stage.work.queueA, *next = &stage.work.queueB;
  uint counter = kCounterQueueA, nextCounter = kCounterQueueB;
  table.set(kBindingQueue, *now);
  setCounter(stage, kCounterRecords, 0);
  setCounter(stage, counter, count);
  stage.recorder.dispatch(isGuided ? kernels.photonEmitGuided : kernels.photonEmit, table, count,
                          PhotonEmitPush{first, count, stream, isGuided ? source.guide->bins() : 0, isGlobal});
  for (uint depth = 0; depth <= maxDepth; ++depth) {
    table.set(kBindingQueue, *now);
    overRays(stage, stage.kernels.traceClosest, table, counter, TracePush{counter});
    overItems(stage, isGlobal ? kernels.photonScatter : kernels.causticScatter, table, counter,
              PhotonScatterPush{counter, stream});
    compact(stage, counter, nextCounter, now, *next, kCounterRecords);
    std::swap(now, next);
    std::swap(counter, nextCounter);
  }
  setCounter(stage, kCounterRaysClosest, 0, kCounterRaysClosest, kCounterRecords);
}

}  // namespace importon
