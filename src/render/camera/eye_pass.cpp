#include "render/camera/eye_pass.h"

#include "render/lists/lists.h"
#include "render/lists/path_queues.h"
#include "shared/bindings.h"

namespace importon {
namespace {

void traceShadowRays(const Stage& stage, gpu::BindingTable table, uint counter) {
  table.set(kBindingRays, stage.work.shadowRays);
  table.set(kBindingRayTexels, stage.work.shadowRays);
  table.set(kBindingHits, stage.work.shadowHits);
  table.set(kBindingHitTexels, stage.work.shadowHits);
  overRays(stage, stage.kernels.traceShadow, table, counter, TracePush{counter});
  overItems(stage, stage.kernels.eyeLight, table, counter, EyeLightPush{counter});
}

void lookUp(const Stage& stage, gpu::BindingTable table, const ImportanceMap& importance, const PhotonMap& map,
            uint counter, bool isGlobal) {
  importance.bind(table);
  if (map.hasIrradiance()) {
    map.bindIrradiance(table);
    overItems(stage, stage.kernels.mapIrradiance, table, counter, map.irradiancePush(counter));
  }
  if (map.isReadByNearest()) {
    map.bindNearest(table);
    overItems(stage, stage.kernels.mapNearest, table, counter, map.nearestPush(counter));
    return;
  }
  map.bindFinished(table);
  overItems(stage, stage.kernels.mapLookup, table, counter, MapLookupPush{counter, isGlobal, map.levelsCounter()});
}

}  // namespace

void traceImage(const Stage& stage, const EyeMaps& maps, const EyeSamples& samples, uint first, uint count,
                uint maxDepth, const gpu::Buffer& film, uint filmOffset) {
  gpu::BindingTable table = stage.work.table;
  maps.globalImportance->bind(table);
  const bool isPlanned = samples.plan != nullptr;
  if (isPlanned) table.set(kBindingSamplePlan, *samples.plan);
  const uint paths = isPlanned ? samples.count : count * samples.count;
  PathQueues queues = startQueues(stage, stage.kernels.eyeEmit, table,
                                  EyeEmitPush{first, paths, count, samples.first, 0, 0, isPlanned});
  for (uint depth = 0; depth <= maxDepth; ++depth) {
    table.set(kBindingQueue, *queues.now);
    overRays(stage, stage.kernels.traceClosest, table, queues.counter, TracePush{queues.counter});
    setCounter(stage, kCounterLookups, 0);
    overItems(stage, stage.kernels.eyeScatter, table, queues.counter, EyeScatterPush{queues.counter, 1});
    traceShadowRays(stage, table, queues.counter);
    table.set(kBindingQueue, stage.work.lookups);
    setCounter(stage, kCounterLookups, 0, kCounterLookups);
    if (maps.caustic != nullptr) lookUp(stage, table, *maps.causticImportance, *maps.caustic, kCounterLookups, false);
    if (maps.global != nullptr && !maps.hasCells && depth > 0)
      lookUp(stage, table, *maps.globalImportance, *maps.global, kCounterLookups, true);
    compact(stage, queues.counter, queues.nextCounter, queues.now, *queues.next, kCounterRaysClosest);
    queues.swap();
  }
  addCounter(stage, kCounterRaysClosest, kSumRaysClosest, true);
  table.set(kBindingFilm, film);
  stage.recorder.dispatch(stage.kernels.filmAdd, table, count,
                          FilmAddPush{count, samples.count, filmOffset, samples.first, isPlanned, paths});
}

void traceAovs(const Stage& stage, const EyeMaps& maps, uint first, uint count, const gpu::Buffer& aov) {
  gpu::BindingTable table = stage.work.table;
  table.set(kBindingAov, aov);
  startQueues(stage, stage.kernels.eyeEmit, table, EyeEmitPush{first, count, count, 0, 0, 1, 0});
  overRays(stage, stage.kernels.traceClosest, table, kCounterQueueA, TracePush{kCounterQueueA});
  stage.recorder.dispatch(stage.kernels.aovSurface, table, count, AovSurfacePush{count});
  const auto addMap = [&](const PhotonMap* map, const ImportanceMap& importance, bool isGlobal) {
    if (map == nullptr) return;
    importance.bind(table);
    map->bindFinished(table);
    stage.recorder.dispatch(stage.kernels.aovMap, table, count, AovMapPush{count, isGlobal, map->levelsCounter()});
    stage.recorder.dispatch(stage.kernels.aovAsk, table, count, AovLightPush{count, isGlobal});
    lookUp(stage, table, importance, *map, kCounterQueueA, isGlobal);
    stage.recorder.dispatch(stage.kernels.aovAnswer, table, count, AovLightPush{count, isGlobal});
  };
  addMap(maps.caustic, *maps.causticImportance, false);
  addMap(maps.global, *maps.globalImportance, true);
  if (!maps.hasCells || maps.global != nullptr) return;
  maps.globalImportance->bind(table);
  stage.recorder.dispatch(stage.kernels.aovCells, table, count, AovCellsPush{count});
}

}  // namespace importon
