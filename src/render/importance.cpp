#include "render/importance.h"

#include <algorithm>
#include <bit>

#include "render/eye_pass.h"
#include "shared/bindings.h"
#include "shared/push_data.h"

namespace importon {
namespace {

/// An empty map with the cells of one of up to `importons` importons.
ImportanceMap makeMap(gpu::Context& context, const char* name, std::uint64_t importons, bool hasDifferentials) {
  ImportanceMap map;
  map.grid = PointGrid(context, name, 0, importons);
  map.importance = gpu::Buffer(context, std::string(name) + " importance", 0, gpu::TexelFormat::float1);
  if (hasDifferentials) map.bound = gpu::Buffer(context, std::string(name) + " bound", 0, gpu::TexelFormat::float1);
  map.hits = gpu::Buffer(context, std::string(name) + " hits", 0, gpu::TexelFormat::uint1);
  return map;
}

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
  gpu::BindingTable table = stage.work.table;
  table.set(kBindingCellsOut, counts.cells);
  selectRecords(stage, recordMask(kind));
  setCounter(stage, kCounterLevels, 0);
  stage.recorder.fill(counts.cells, 0);
  overItems(stage, stage.kernels.importonCount, table, kCounterSelected, ImportonCountPush{counts.slotMask});
  overItems(stage, stage.kernels.importonLevel, table, kCounterSelected,
            ImportonLevelPush{counts.slotMask, nearest});
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
  gpu::BindingTable table = stage.work.table;
  table.set(kBindingKeysOut, stage.work.keysA);
  overItems(stage, stage.kernels.importonEntries, table, kCounterEntries,
            ImportonEntriesPush{grid.slotMask, levels});
  sortIntoCells(stage, grid, kCounterEntries);
  table.set(kBindingValuesIn, grid.order);
  table.set(kBindingPointsOut, grid.points);
  table.set(kBindingWeightsOut, weights);
  overItems(stage, stage.kernels.importonPoints, table, kCounterEntries, ImportonPointsPush{levels});
  bindStored(table, grid);
  table.set(kBindingWeights, weights);
  overItems(stage, stage.kernels.importonDensity, table, kCounterSites, ImportonDensityPush{levels, nearest});
  if (stage.work.hasDifferentials())
    overItems(stage, stage.kernels.importonBound, table, kCounterSites, ImportonBoundPush{levels});
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
  gpu::BindingTable table = stage.work.table;
  table.set(kBindingKeysOut, stage.work.keysA);
  overItems(stage, stage.kernels.importonKey, table, kCounterSites, ImportonKeyPush{map.grid.slotMask});
  buildGrid(stage, map.grid, kCounterSites, stage.work.selectedPoints);
  table.set(kBindingValuesIn, map.grid.order);
  table.set(kBindingWeightsOut, map.importance);
  stage.recorder.dispatch(stage.kernels.importonResolve, table, sites);
  if (stage.work.hasDifferentials()) {
    table.set(kBindingRequired, stage.work.bounds);
    table.set(kBindingWeightsOut, map.bound);
    stage.recorder.dispatch(stage.kernels.importonResolve, table, sites);
  }
  stage.recorder.submitAndWait();
  map.levels = readCounter(stage, kCounterLevels);
}

}  // namespace

void ImportanceMap::bind(gpu::BindingTable& table) const {
  table.set(kBindingImportonCells, grid.cells);
  table.set(kBindingImportonPoints, grid.points);
  table.set(kBindingImportance, importance);
  table.set(kBindingImportanceBound, bound ? bound : importance);
  table.set(kBindingImportonHits, hits);
  table.set(kBindingImportonHitsOut, hits);
}

std::vector<MapPoint> ImportanceMap::readPoints() const {
  if (count == 0) return {};
  return grid.points.download<MapPoint>(sites());
}

ImportanceMaps makeImportanceMaps(gpu::Context& context, std::uint64_t importons, bool hasDifferentials) {
  return {makeMap(context, "caustic importons", importons, hasDifferentials),
          makeMap(context, "global importons", importons, hasDifferentials)};
}

void buildImportance(const Stage& stage, Parameters& parameters, ImportanceMaps& maps, std::uint32_t importons,
                     uint nearest, bool needsCausticMap) {
  for (const bool knowsImportance : {false, true}) {
    // The first round only has to tell short gather segments from long ones.
    const std::uint32_t count = knowsImportance ? importons : std::max(importons / 4, 1u);
    parameters.globalMap.importonFlux = parameters.causticMap.importonFlux = parameters.importonFlux =
        static_cast<float>(parameters.width) * static_cast<float>(parameters.height) / static_cast<float>(count);
    stage.work.parameters.upload(std::span<const Parameters>(&parameters, 1));
    stage.recorder.fill(stage.work.counters, 0);
    traceImportons(stage, maps.global, count, parameters.maxDepth, knowsImportance);
    buildMap(stage, maps.global, MapKind::global, nearest);
    parameters.globalMap.importonLevels = maps.global.levels;
    if (knowsImportance && needsCausticMap) {
      buildMap(stage, maps.caustic, MapKind::caustic, nearest);
      parameters.causticMap.importonLevels = maps.caustic.levels;
    } else if (knowsImportance) {
      selectRecords(stage, recordMask(MapKind::caustic));
      stage.recorder.submitAndWait();
      maps.caustic.count = readCounter(stage, kCounterSelected);
    }
  }
}

}  // namespace importon
