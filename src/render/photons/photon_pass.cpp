#include "render/photons/photon_pass.h"

#include <utility>

#include "kernels/site_emit.h"
#include "render/lists/lists.h"
#include "render/lists/room.h"

namespace importon {

namespace {

/// Traces what stands in queue A and scatters it, by the guide if there is one.
void tracePaths(const Stage& stage, MapKind kind, const ScatterGuide* guide, uint stream, std::uint32_t count,
                uint maxDepth) {
  const gpu::Buffer *now = &stage.work.queueA, *next = &stage.work.queueB;
  uint counter = kCounterQueueA, nextCounter = kCounterQueueB;
  RecordRoom room(stage, count);
  for (uint depth = 0; depth <= maxDepth && room.makeRoom(counter, maxDepth - depth + 1); ++depth) {
    const buffers::Queue queue{*now};
    const kernels::PhotonScatter::Push push{
        .source = counter, .stream = stream, .guide = guide != nullptr ? guide->grid() : ScatterGrid{}};
    traceClosest(stage, counter, queue);
    if (guide != nullptr)
      overItems<kernels::PhotonScatterGuided>(stage, counter, push, queue, buffers::ScatterGuides{guide->cells()});
    else if (kind == MapKind::global)
      overItems<kernels::PhotonScatter>(stage, counter, push, queue);
    else
      overItems<kernels::CausticScatter>(stage, counter, push, queue);
    compact(stage, counter, nextCounter, now, *next, kCounterRecords);
    std::swap(now, next);
    std::swap(counter, nextCounter);
  }
  addCounter(stage, kCounterRecords, kSumRaysClosest);
}

}  // namespace

void tracePhotons(const Stage& stage, const PhotonSource& source, std::uint32_t first, std::uint32_t count,
                  uint maxDepth) {
  const EmissionGuide* guide = source.guide;
  const uint plain = traitsOf(source.kind).randomStream;
  const uint stream = (guide != nullptr ? guide->stream() : plain) + (source.isPilot ? kStreamPilot : 0);
  const kernels::PhotonEmit::Push push{.firstPhoton = first,
                                       .count = count,
                                       .stream = stream,
                                       .bins = guide != nullptr ? guide->bins() : 0,
                                       .isGlobal = source.kind == MapKind::global};
  const buffers::Queue queue{stage.work.queueA};
  setCounter(stage, kCounterRecords, 0);
  setCounter(stage, kCounterQueueA, count);
  if (guide != nullptr)
    run<kernels::PhotonEmitGuided>(stage, count, push, queue, guide->buffers());
  else
    run<kernels::PhotonEmitByPower>(stage, count, push, queue);
  tracePaths(stage, source.kind, source.scatter, stream, count, maxDepth);
}

void trainScatterGuide(const Stage& stage, const ImportanceMap& importance, ScatterGuide& guide,
                       const ScatterBatch& batch) {
  setCounter(stage, kCounterRecords, 0);
  setCounter(stage, kCounterQueueA, batch.count);
  run<kernels::SiteEmit>(stage, batch.count,
                         {.first = batch.first,
                          .count = batch.count,
                          .sites = static_cast<uint>(importance.sites()),
                          .meanImportance = batch.meanImportance,
                          .hitsPerPass = batch.hitsPerPass,
                          .isPotential = guide.isPotential()},
                         buffers::Queue{stage.work.queueA},
                         buffers::ImportonHits{batch.sites != nullptr ? batch.sites->hits() : importance.hits},
                         importance.buffers());
  tracePaths(stage, MapKind::global, nullptr, kStreamSites, batch.count, batch.maxDepth);
  selectRecords(stage, recordMask(MapKind::global));
  guide.train(stage);
}

}  // namespace importon
