#include "render/workspace.h"

#include <algorithm>

#include "shared/bindings.h"
#include "shared/push_data.h"
#include "shared/ray_data.h"

namespace importon {

using gpu::Buffer;
using gpu::TexelFormat;

Workspace::Workspace(gpu::Context& c, const WorkspaceSize& s)
    : parameters(c, "parameters", sizeof(Parameters)),
      counters(c, "counters", kCounterCount * sizeof(uint)),
      dispatches(c, "dispatches", kCounterCount * sizeof(DispatchArguments)),
      rays(c, "rays", s.slots * sizeof(Ray), TexelFormat::uint4),
      hits(c, "hits", s.slots * sizeof(Hit), TexelFormat::uint4),
      shadowRays(c, "shadow rays", s.slots * sizeof(Ray), TexelFormat::uint4),
      shadowHits(c, "shadow hits", s.slots * sizeof(Hit), TexelFormat::uint4),
      shadowLight(c, "shadow light", s.slots * sizeof(vec3)),
      paths(c, "paths", s.slots * sizeof(PathState)),
      eyeVertices(c, "eye vertices", s.slots * sizeof(EyeVertex)),
      pathLight(c, "path light", s.slots * sizeof(PathLight)),
      queueA(c, "queue A", s.slots * sizeof(uint)),
      queueB(c, "queue B", s.slots * sizeof(uint)),
      keep(c, "keep", std::max(s.entries, s.slots) * sizeof(uint)),
      blockSums(c, "block sums", (std::max(s.entries, s.slots) + kTileSize) * sizeof(uint)),
      keysA(c, "keys A", s.entries * sizeof(uint)),
      keysB(c, "keys B", s.entries * sizeof(uint)),
      valuesA(c, "values A", s.entries * sizeof(uint)),
      valuesB(c, "values B", s.entries * sizeof(uint)),
      recordPoints(c, "record points", s.records * sizeof(MapPoint), TexelFormat::uint4),
      records(c, "records", s.records * sizeof(Record)),
      required(c, "required density", s.records * sizeof(float)),
      selection(c, "selection", s.records * sizeof(uint)),
      selectedPoints(c, "selected points", s.records * sizeof(MapPoint), TexelFormat::uint4),
      neighbours(c, "neighbours", s.records * sizeof(uint)),
      accepted(c, "accepted", s.records * sizeof(uint)),
      pathDifferentials(c, "path differentials", (s.hasDifferentials ? s.slots : 1) * sizeof(PathDifferential)),
      footprints(c, "footprints", (s.hasDifferentials ? s.records : 1) * sizeof(float)),
      bounds(c, "importance bounds", (s.hasDifferentials ? s.records : 1) * sizeof(float)),
      lightsSeen(c, "lights seen", s.lightVoxels * sizeof(uvec2), TexelFormat::uint2),
      noCells(c, "no cells", 2 * sizeof(uvec4), TexelFormat::uint4),
      noCellsOfTriangles(c, "no cells of triangles", sizeof(uvec2), TexelFormat::uint2),
      lookups(c, "lookups", s.slots * sizeof(uint)),
      noSamplePlan(c, "no sample plan", sizeof(uvec2), TexelFormat::uint2),
      noGuide(c, "no guide", sizeof(float), TexelFormat::float1),
      size(s) {
  lightsSeen.upload(std::span<const uvec2>(std::vector<uvec2>(s.lightVoxels)));
  table.set(kBindingLightsSeen, lightsSeen);
  table.set(kBindingLightsSeenOut, lightsSeen);
  table.set(kBindingSurfaceCells, noCellsOfTriangles);
  table.set(kBindingCellPlaces, noCellsOfTriangles);
  for (const uint binding : {kBindingRecordCells, kBindingIrradiance, kBindingIrradianceTexels, kBindingCellIrradiance})
    table.set(binding, noCells);
  table.set(kBindingLookups, lookups);
  table.set(kBindingSamplePlan, noSamplePlan);
  table.set(kBindingGuideRows, noGuide);
  table.set(kBindingGuideColumns, noGuide);
  table.set(kBindingScatterGuide, noGuide);
  table.set(kBindingPathDifferentials, pathDifferentials);
  table.set(kBindingFootprints, footprints);
  table.set(kBindingBounds, bounds);
  table.set(kBindingParameters, parameters);
  table.set(kBindingCounters, counters);
  table.set(kBindingDispatches, dispatches);
  table.set(kBindingRays, rays);
  table.set(kBindingRayTexels, rays);
  table.set(kBindingHits, hits);
  table.set(kBindingHitTexels, hits);
  table.set(kBindingShadowRays, shadowRays);
  table.set(kBindingShadowLight, shadowLight);
  table.set(kBindingPaths, paths);
  table.set(kBindingEyeVertices, eyeVertices);
  table.set(kBindingPathLight, pathLight);
  table.set(kBindingKeep, keep);
  table.set(kBindingBlockSums, blockSums);
  table.set(kBindingRecordPoints, recordPoints);
  table.set(kBindingRecords, records);
  table.set(kBindingRequired, required);
  table.set(kBindingSelection, selection);
  table.set(kBindingSelectedPoints, selectedPoints);
  table.set(kBindingNeighbours, neighbours);
}

void setCounter(const Stage& stage, uint counter, uint value, uint a, uint b, uint limit) {
  stage.recorder.dispatch(stage.kernels.setCounter, stage.work.table, 1,
                          SetCounterPush{counter, value, a, b, limit});
}

void addCounter(const Stage& stage, uint counter, uint sum, bool empties) {
  stage.recorder.dispatch(stage.kernels.addCounter, stage.work.table, 1, AddCounterPush{counter, sum, empties});
}

void compact(const Stage& stage, uint source, uint target, const Buffer* in, const Buffer& out, uint accumulate) {
  gpu::BindingTable table = stage.work.table;
  table.set(kBindingQueue, in != nullptr ? *in : out);
  table.set(kBindingNextQueue, out);
  overTiles(stage, stage.kernels.compactCount, table, source, CompactCountPush{source});
  stage.recorder.dispatch(stage.kernels.scan, table, kScanThreads, ScanPush{source, 1, target, accumulate});
  overTiles(stage, stage.kernels.compactScatter, table, source, CompactScatterPush{source, in == nullptr});
}

void selectRecords(const Stage& stage, uint mask) {
  overItems(stage, stage.kernels.recordSelect, stage.work.table, kCounterRecords,
            RecordSelectPush{kCounterRecords, mask});
  compact(stage, kCounterRecords, kCounterSelected, nullptr, stage.work.selection);
}

const Buffer& sortByKey(const Stage& stage, uint source, uint bits, const Buffer& order) {
  Workspace& work = stage.work;
  const Buffer *keysIn = &work.keysA, *keysOut = &work.keysB, *valuesIn = &work.valuesA, *valuesOut = &work.valuesB;
  gpu::BindingTable table = work.table;
  for (uint shift = 0; shift < bits; shift += kRadixBits) {
    const bool isLast = shift + kRadixBits >= bits;
    table.set(kBindingKeysIn, *keysIn);
    table.set(kBindingKeysOut, *keysOut);
    table.set(kBindingValuesIn, *valuesIn);
    table.set(kBindingValuesOut, isLast ? order : *valuesOut);
    overTiles(stage, stage.kernels.sortCount, table, source, SortCountPush{source, shift});
    stage.recorder.dispatch(stage.kernels.scan, table, kScanThreads, ScanPush{source, kRadix, kNone, kNone});
    overTiles(stage, stage.kernels.sortScatter, table, source, SortScatterPush{source, shift, shift == 0});
    std::swap(keysIn, keysOut);
    std::swap(valuesIn, valuesOut);
  }
  return *keysIn;
}

}  // namespace importon
