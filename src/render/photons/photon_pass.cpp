#include "render/photons/photon_pass.h"

#include <functional>
#include <utility>

#include "kernels/site_emit.h"
#include "render/lists/lists.h"
#include "render/lists/room.h"

namespace importon {

namespace {

/// What else is done with the rays of a queue once they were traced; may be empty.
using AfterTrace = std::function<void(uint counter, const gpu::Buffer& queue)>;

/// Traces what stands in queue A and scatters it, by the guide if there is one.
void tracePaths(const Stage& stage, MapKind kind, const ScatterGuide* guide, uint stream, std::uint32_t count,
                uint maxDepth, const AfterTrace& afterTrace = {}) {
  const gpu::Buffer *now = &stage.work.queueA, *next = &stage.work.queueB;
  uint counter = kCounterQueueA, nextCounter = kCounterQueueB;
  RecordRoom room(stage, count);
  for (uint depth = 0; depth <= maxDepth && room.makeRoom(counter, maxDepth - depth + 1); ++depth) {
    const buffers::Queue queue{*now};
    const kernels::PhotonScatter::Push push{
        .source = counter, .stream = stream, .guide = guide != nullptr ? guide->grid() : ScatterGrid{}};
    traceClosest(stage, counter, queue);
    if (afterTrace) afterTrace(counter, *now);
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

/// Into queue A.
void emitFromSites(const Stage& stage, MapKind kind, const ImportanceMap& importance, const ScatterBatch& batch,
                   bool isPotential) {
  setCounter(stage, kCounterRecords, 0);
  setCounter(stage, kCounterQueueA, batch.count);
  run<kernels::SiteEmit>(stage, batch.count,
                         {.first = batch.first,
                          .count = batch.count,
                          .sites = static_cast<uint>(importance.sites()),
                          .meanImportance = batch.meanImportance,
                          .hitsPerPass = batch.hitsPerPass,
                          .isPotential = isPotential,
                          .isGlobal = kind == MapKind::global},
                         buffers::Queue{stage.work.queueA},
                         buffers::ImportonHits{batch.sites != nullptr ? batch.sites->hits() : importance.hits},
                         importance.buffers());
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
    run<kernels::PhotonEmitGuided>(stage, count, push, queue, guide->buffers(stage.work.standIns));
  else
    run<kernels::PhotonEmitByPower>(stage, count, push, queue);
  tracePaths(stage, source.kind, source.scatter, stream, count, maxDepth);
}

void trainScatterGuide(const Stage& stage, const ImportanceMap& importance, ScatterGuide& guide,
                       const ScatterBatch& batch) {
  emitFromSites(stage, MapKind::global, importance, batch, guide.isPotential());
  tracePaths(stage, MapKind::global, nullptr, kStreamSites, batch.count, batch.maxDepth);
  selectRecords(stage, recordMask(MapKind::global));
  guide.train(stage);
}

void noteEscapes(const Stage& stage, MapKind kind, const ImportanceMap& importance, const EnvironmentGuide& guide,
                 const ScatterBatch& batch) {
  emitFromSites(stage, kind, importance, batch, false);
  tracePaths(stage, kind, nullptr, kStreamSites, batch.count, batch.maxDepth,
             [&](uint counter, const gpu::Buffer& queue) {
               guide.note(stage, counter, queue, batch.first, kind == MapKind::caustic);
             });
}

}  // namespace importon
