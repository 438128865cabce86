#include "render/photons/photon_pass.h"

#include <utility>

#include "render/lists/lists.h"
#include "render/lists/room.h"
#include "shared/bindings.h"
#include "shared/push_data.h"

namespace importon {

namespace {

/// Traces what stands in queue A and scatters it, by the guide if there is one.
void tracePaths(const Stage& stage, gpu::BindingTable& table, MapKind kind, const ScatterGuide* guide, uint stream,
                std::uint32_t count, uint maxDepth) {
  const KernelSet& kernels = stage.kernels;
  const gpu::Kernel& plain = kind == MapKind::global ? kernels.photonScatter : kernels.causticScatter;
  if (guide != nullptr) guide->bind(table);
  const gpu::Buffer *now = &stage.work.queueA, *next = &stage.work.queueB;
  uint counter = kCounterQueueA, nextCounter = kCounterQueueB;
  RecordRoom room(stage, count);
  for (uint depth = 0; depth <= maxDepth && room.makeRoom(counter, maxDepth - depth + 1); ++depth) {
    table.set(kBindingQueue, *now);
    overRays(stage, kernels.traceClosest, table, counter, TracePush{counter});
    overItems(stage, guide != nullptr ? kernels.photonScatterGuided : plain, table, counter,
              PhotonScatterPush{counter, stream, guide != nullptr ? guide->grid() : ScatterGrid{}});
    compact(stage, counter, nextCounter, now, *next, kCounterRecords);
    std::swap(now, next);
    std::swap(counter, nextCounter);
  }
  addCounter(stage, kCounterRecords, kSumRaysClosest);
}

}  // namespace

void tracePhotons(const Stage& stage, const PhotonSource& source, std::uint32_t first, std::uint32_t count,
                  uint maxDepth) {
  const KernelSet& kernels = stage.kernels;
  const bool isGlobal = source.kind == MapKind::global, isGuided = source.guide != nullptr;
  const uint plain = traitsOf(source.kind).randomStream;
  const uint stream = (isGuided ? source.guide->stream() : plain) + (source.isPilot ? kStreamPilot : 0);
  gpu::BindingTable table = stage.work.table;
  if (isGuided) source.guide->bind(table);
  table.set(kBindingQueue, stage.work.queueA);
  setCounter(stage, kCounterRecords, 0);
  setCounter(stage, kCounterQueueA, count);
  stage.recorder.dispatch(isGuided ? kernels.photonEmitGuided : kernels.photonEmit, table, count,
                          PhotonEmitPush{first, count, stream, isGuided ? source.guide->bins() : 0, isGlobal});
  tracePaths(stage, table, source.kind, source.scatter, stream, count, maxDepth);
}

void trainScatterGuide(const Stage& stage, const ImportanceMap& importance, ScatterGuide& guide,
                       const ScatterBatch& batch) {
  gpu::BindingTable table = stage.work.table;
  importance.bind(table);
  if (batch.sites != nullptr) batch.sites->bind(table);
  table.set(kBindingQueue, stage.work.queueA);
  setCounter(stage, kCounterRecords, 0);
  setCounter(stage, kCounterQueueA, batch.count);
  const auto sites = static_cast<uint>(importance.sites());
  stage.recorder.dispatch(
      stage.kernels.siteEmit, table, batch.count,
      SiteEmitPush{batch.first, batch.count, sites, batch.meanImportance, batch.hitsPerPass, guide.isPotential()});
  tracePaths(stage, table, MapKind::global, nullptr, kStreamSites, batch.count, batch.maxDepth);
  selectRecords(stage, recordMask(MapKind::global));
  guide.train(stage);
}

}  // namespace importon
