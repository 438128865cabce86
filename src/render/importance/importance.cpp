#include "render/importance/importance.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "kernels/importon_bound.h"
#include "kernels/importon_count.h"
#include "kernels/importon_density.h"
#include "kernels/importon_entries.h"
#include "kernels/importon_key.h"
#include "kernels/importon_level.h"
#include "kernels/importon_points.h"
#include "kernels/importon_resolve.h"
#include "render/importance/importon_pass.h"
#include "render/lists/lists.h"
#include "render/lists/room.h"
#include "shared/ray_data.h"

namespace importon {
namespace {

void makeRoomForSites(const Stage& stage, ImportanceMap& map) {
  const std::uint64_t sites = std::max<std::uint64_t>(map.sites(), 1);
  resize(stage, map.grid.points, sites * sizeof(MapPoint));
  resize(stage, map.grid.order, sites * sizeof(uint));
  resize(stage, map.importance, sites * sizeof(float));
  if (map.bound) resize(stage, map.bound, sites * sizeof(float));
  resize(stage, map.hits, sites * sizeof(uint));
}

/// Selects the importons of `kind` and finds the grid levels at which their neighbours are searched.
uint selectImportons(const Stage& stage, MapKind kind, const PointGrid& counts, uint nearest) {
  const buffers::Counts countBuffer{counts.cells};
  selectRecords(stage, recordMask(kind));
  setCounter(stage, kCounterLevels, 0);
  stage.recorder.fill(counts.cells, 0);
  overItems<kernels::ImportonCount>(stage, kCounterSelected, {.slotMask = counts.slotMask}, countBuffer);
  overItems<kernels::ImportonLevel>(stage, kCounterSelected, {.slotMask = counts.slotMask, .nearest = nearest},
                                    countBuffer, buffers::StartLevels{stage.work.neighbours});
  stage.recorder.submitAndWait();
  return readCounter(stage, kCounterLevels);
}

/// Importance at each site among the selected importons, into work.required.
void estimateImportance(const Stage& stage, uint levels, uint count, uint nearest) {
  const std::uint64_t entries = std::uint64_t{count} * static_cast<uint>(std::popcount(levels));
  PointGrid grid(stage.gpu, "importon entries", std::max<std::uint64_t>(entries, 1));
  gpu::Buffer weights(stage.gpu, "importon weights", std::max<std::uint64_t>(entries, 1) * sizeof(float),
                      gpu::TexelFormat::float1);
  setCounter(stage, kCounterEntries, static_cast<uint>(entries));
  reserveEntries(stage, entries);
  overItems<kernels::ImportonEntries>(stage, kCounterEntries, {.slotMask = grid.slotMask, .levels = levels},
                                      buffers::Keys{stage.work.keysA});
  sortIntoCells(stage, grid, kCounterEntries);
  overItems<kernels::ImportonPoints>(stage, kCounterEntries, {.levels = levels}, buffers::Order{grid.order},
                                     buffers::PointsOut{grid.points}, buffers::Weights{weights});
  overItems<kernels::ImportonDensity>(stage, kCounterSites, {.levels = levels, .nearest = nearest}, SearchedGrid(grid),
                                      buffers::Weights{weights}, buffers::StartLevels{stage.work.neighbours});
  if (stage.work.hasDifferentials())
    overItems<kernels::ImportonBound>(stage, kCounterSites, {.levels = levels}, SearchedGrid(grid),
                                      buffers::Weights{weights});
  stage.recorder.submitAndWait();  // before the entries go
}

void buildMap(const Stage& stage, ImportanceMap& map, MapKind kind, uint nearest) {
  map.levels = selectImportons(stage, kind, map.grid, nearest);
  map.count = readCounter(stage, kCounterSelected);
  makeRoomForSites(stage, map);
  stage.recorder.fill(map.hits, 0);
  if (map.count == 0) {
    stage.recorder.fill(map.grid.cells, 0);
    return;
  }
  const uint sites = static_cast<uint>((map.count + kImportonsPerSite - 1) / kImportonsPerSite);
  setCounter(stage, kCounterSites, sites);
  estimateImportance(stage, map.levels, static_cast<uint>(map.count), nearest);
  setCounter(stage, kCounterLevels, 0);
  reserveEntries(stage, sites);
  overItems<kernels::ImportonKey>(stage, kCounterSites, {.slotMask = map.grid.slotMask},
                                  buffers::Keys{stage.work.keysA});
  buildGrid(stage, map.grid, kCounterSites, stage.work.selectedPoints);
  const buffers::Order order{map.grid.order};
  run<kernels::ImportonResolve>(stage, sites, {}, order, buffers::Importance{map.importance});
  if (stage.work.hasDifferentials())
    run<kernels::ImportonResolve>(stage, sites, {}, order, buffers::Required{stage.work.bounds},
                                  buffers::Importance{map.bound});
  stage.recorder.submitAndWait();
  map.levels = readCounter(stage, kCounterLevels);
  checkLookups(readCounter(stage, kCounterLookupsUnfinished));  // passes begin with counters of 0
}

}  // namespace

ImportanceMap makeImportanceMap(gpu::Context& context, MapKind kind, std::uint64_t importons, bool hasDifferentials) {
  const std::string name = fmt::format("{} importons", traitsOf(kind).name);
  ImportanceMap map;
  map.grid = PointGrid(context, name.c_str(), 0, importons);
  map.importance = gpu::Buffer(context, name + " importance", 0, gpu::TexelFormat::float1);
  if (hasDifferentials) map.bound = gpu::Buffer(context, name + " bound", 0, gpu::TexelFormat::float1);
  map.hits = gpu::Buffer(context, name + " hits", 0, gpu::TexelFormat::uint1);
  return map;
}

ImportanceBuffers ImportanceMap::buffers() const {
  return {grid.cells, grid.points, importance, bound ? bound : importance, hits};
}

std::vector<MapPoint> ImportanceMap::readPoints() const {
  if (count == 0) return {};
  return grid.points.download<MapPoint>(sites());
}

void buildImportance(const Stage& stage, Parameters& parameters, ImportanceMap& caustic, ImportanceMap& global,
                     const ImportanceJob& job) {
  for (const bool knowsImportance : {false, true}) {
    // The first round only has to tell short gather segments from long ones.
    const std::uint32_t count = knowsImportance ? job.importons : std::max(job.importons / 4, 1u);
    parameters.globalMap.importonFlux = parameters.causticMap.importonFlux = parameters.importonFlux =
        static_cast<float>(parameters.width) * static_cast<float>(parameters.height) / static_cast<float>(count);
    stage.work.parameters.upload(std::span<const Parameters>(&parameters, 1));
    stage.recorder.fill(stage.work.counters, 0);
    traceImportons(stage, global, count, parameters.maxDepth, knowsImportance);
    buildMap(stage, global, MapKind::global, job.nearest);
    parameters.globalMap.importonLevels = global.levels;
    if (knowsImportance && job.needsCausticMap) {
      buildMap(stage, caustic, MapKind::caustic, job.nearest);
      parameters.causticMap.importonLevels = caustic.levels;
    } else if (knowsImportance) {
      selectRecords(stage, recordMask(MapKind::caustic));
      stage.recorder.submitAndWait();
      caustic.count = readCounter(stage, kCounterSelected);
    }
  }
}

}  // namespace importon
