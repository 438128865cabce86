#include "render/camera/eye_pass.h"

#include "kernels/aov_answer.h"
#include "kernels/aov_ask.h"
#include "kernels/aov_cells.h"
#include "kernels/aov_map.h"
#include "kernels/aov_surface.h"
#include "kernels/eye_light.h"
#include "kernels/film_add.h"
#include "render/lists/lists.h"
#include "render/lists/path_queues.h"

namespace importon {
namespace {

/// Traces shadow rays of the paths of a queue, and adds the light that arrives.
void addDirectLight(const Stage& stage, uint counter, const buffers::Queue& queue) {
  const buffers::Hits hits{stage.work.shadowHits};
  traceShadow(stage, counter, queue, hits, buffers::Rays{stage.work.shadowRays});
  overItems<kernels::EyeLight>(stage, counter, {.source = counter}, queue, hits);
}

}  // namespace

void traceImage(const Stage& stage, const EyeMaps& maps, const EyeSamples& samples, uint first, uint count,
                uint maxDepth, const gpu::Buffer& film, uint filmOffset) {
  const bool isPlanned = samples.plan != nullptr;
  const buffers::SamplePlan plan{isPlanned ? *samples.plan : stage.work.standIns.samplePlan};
  const uint paths = isPlanned ? samples.count : count * samples.count;
  PathQueues queues = startQueues<kernels::EyeEmit>(stage,
                                                    {.first = first,
                                                     .count = paths,
                                                     .pixels = count,
                                                     .firstSample = samples.first,
                                                     .total = 0,
                                                     .isCentred = false,
                                                     .isPlanned = isPlanned},
                                                    plan);
  for (uint depth = 0; depth <= maxDepth && anyIsAlive(stage, queues.counter, depth); ++depth) {
    const buffers::Queue queue{*queues.now};
    traceClosest(stage, queues.counter, queue);
    setCounter(stage, kCounterLookups, 0);
    overItems<kernels::EyeScatter>(stage, queues.counter, {.source = queues.counter, .knowsImportance = true}, queue,
                                   maps.globalImportance->buffers());
    addDirectLight(stage, queues.counter, queue);
    setCounter(stage, kCounterLookups, 0, kCounterLookups);
    if (maps.caustic != nullptr)
      maps.caustic->lookUp(stage, *maps.causticImportance, kCounterLookups, stage.work.lookups);
    if (maps.global != nullptr && !maps.hasCells && depth > 0)
      maps.global->lookUp(stage, *maps.globalImportance, kCounterLookups, stage.work.lookups);
    compact(stage, queues.counter, queues.nextCounter, queues.now, *queues.next, kCounterRaysClosest);
    queues.swap();
  }
  addCounter(stage, kCounterRaysClosest, kSumRaysClosest, true);
  run<kernels::FilmAdd>(stage, count,
                        {.count = count,
                         .samples = samples.count,
                         .offset = filmOffset,
                         .first = samples.first,
                         .isPlanned = isPlanned,
                         .paths = paths,
                         .firstPixel = first},
                        plan, buffers::Film{film});
}

void traceAovs(const Stage& stage, const EyeMaps& maps, uint first, uint count, const gpu::Buffer& aov) {
  const buffers::Aov layers{aov};
  const buffers::Queue queue{stage.work.queueA};
  startQueues<kernels::EyeEmit>(stage, {.first = first,
                                        .count = count,
                                        .pixels = count,
                                        .firstSample = 0,
                                        .total = 0,
                                        .isCentred = true,
                                        .isPlanned = false});
  traceClosest(stage, kCounterQueueA, queue);
  run<kernels::AovSurface>(stage, count, {.count = count}, layers);
  const auto addMap = [&](const PhotonMap* map, const ImportanceMap& importance, bool isGlobal) {
    if (map == nullptr) return;
    run<kernels::AovMap>(stage, count, {.count = count, .isGlobal = isGlobal, .levels = map->levelsCounter()}, layers,
                         importance.buffers(), map->finished());
    run<kernels::AovAsk>(stage, count, {.count = count, .isGlobal = isGlobal});
    map->lookUp(stage, importance, kCounterQueueA, stage.work.queueA);
    run<kernels::AovAnswer>(stage, count, {.count = count, .isGlobal = isGlobal}, layers);
  };
  addMap(maps.caustic, *maps.causticImportance, false);
  addMap(maps.global, *maps.globalImportance, true);
  if (!maps.hasCells || maps.global != nullptr) return;
  run<kernels::AovCells>(stage, count, {.count = count}, layers, maps.globalImportance->buffers());
}

}  // namespace importon
