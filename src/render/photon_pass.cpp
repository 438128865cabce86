#include "render/photon_pass.h"

#include <utility>

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
  const uint plain = isGlobal ? kStreamGlobalPhotons : kStreamCausticPhotons;
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

void teachScatter(const Stage& stage, const ImportanceMap& importance, ScatterGuide& guide, const ScatterLesson& lesson) {
  gpu::BindingTable table = stage.work.table;
  importance.bind(table);
  if (lesson.sites != nullptr) lesson.sites->bind(table);
  table.set(kBindingQueue, stage.work.queueA);
  setCounter(stage, kCounterRecords, 0);
  setCounter(stage, kCounterQueueA, lesson.count);
  const auto sites = static_cast<uint>(importance.sites());
  stage.recorder.dispatch(stage.kernels.siteEmit, table, lesson.count,
                          SiteEmitPush{lesson.first, lesson.count, sites, lesson.meanImportance, lesson.hitsPerPass, guide.isPotential()});
  tracePaths(stage, table, MapKind::global, nullptr, kStreamSites, lesson.count, lesson.maxDepth);
  selectRecords(stage, recordMask(MapKind::global));
  guide.learn(stage);
}

}  // namespace importon
