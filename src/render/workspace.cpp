#include "render/workspace.h"

#include <algorithm>

#include "shared/bindings.h"
#include "shared/push_data.h"
#include "shared/ray_data.h"

namespace importon {

using gpu::Buffer;
using gpu::TexelFormat;

namespace {

/// Of lists of `compacted` and of `sorted` entries: a sum for each tile, or one for each of its digits.
std::uint64_t blockSumsOf(std::uint64_t compacted, std::uint64_t sorted) {
  const auto tiles = [](std::uint64_t entries) { return (entries + kTileSize - 1) / kTileSize; };
  return std::max(tiles(compacted), tiles(sorted) * kRadix);
}

/// Makes room for `room` records and keeps the first `kept` ones.
void resizeRecords(const Stage& stage, std::uint64_t room, std::uint64_t kept) {
  Workspace& work = stage.work;
  const auto grow = [&](gpu::Buffer& buffer, std::uint64_t bytes, bool isKept) {
    resize(stage, buffer, room * bytes, isKept ? kept * bytes : 0);
  };
  for (gpu::Buffer* list : {&work.required, &work.selection, &work.neighbours, &work.accepted})
    grow(*list, sizeof(uint), false);
  grow(work.selectedPoints, sizeof(MapPoint), false);
  grow(work.recordPoints, sizeof(MapPoint), true);
  grow(work.records, sizeof(Record), true);
  if (work.size.hasCells) grow(work.recordCells, sizeof(uvec2), true);
  if (work.hasDifferentials()) {
    grow(work.footprints, sizeof(float), true);
    grow(work.bounds, sizeof(float), false);
  }
  if (work.keep.bytes() < room * sizeof(uint)) grow(work.keep, sizeof(uint), false);
  const std::uint64_t sums = blockSumsOf(room, work.entryRoom()) * sizeof(uint);
  if (work.blockSums.bytes() < sums) resize(stage, work.blockSums, sums);
}

}  // namespace

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
      keep(c, "keep", s.slots * sizeof(uint)),
      blockSums(c, "block sums", blockSumsOf(s.slots, 0) * sizeof(uint)),
      keysA(c, "keys A", 0),
      keysB(c, "keys B", 0),
      valuesA(c, "values A", 0),
      valuesB(c, "values B", 0),
      recordPoints(c, "record points", 0, TexelFormat::uint4),
      records(c, "records", 0),
      required(c, "required density", 0),
      selection(c, "selection", 0),
      selectedPoints(c, "selected points", 0, TexelFormat::uint4),
      neighbours(c, "neighbours", 0),
      accepted(c, "accepted", 0),
      recordCells(c, "cells of hits", 0),
      pathDifferentials(c, "path differentials", (s.hasDifferentials ? s.slots : 1) * sizeof(PathDifferential)),
      footprints(c, "footprints", 0),
      bounds(c, "importance bounds", 0),
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
  table.set(kBindingRecordCells, recordCells);
  for (const uint binding : {kBindingIrradiance, kBindingIrradianceTexels, kBindingCellIrradiance})
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

void resize(const Stage& stage, Buffer& buffer, std::uint64_t bytes, std::uint64_t kept) {
  stage.recorder.submitAndWait();  // what was recorded uses the old one
  const std::string name = buffer.name();
  const TexelFormat texels = buffer.texels();
  if (kept == 0) buffer = {};  // its memory is free before more is asked for
  Buffer resized(stage.gpu, name, bytes, texels);
  if (kept > 0) {
    stage.recorder.copy(buffer, 0, resized, 0, kept);
    stage.recorder.submitAndWait();
  }
  buffer = std::move(resized);
}

std::uint64_t roomFor(std::uint64_t needed, std::uint64_t most) { return std::min(needed + needed / 4, most); }

void reserveEntries(const Stage& stage, std::uint64_t entries) {
  Workspace& work = stage.work;
  if (entries <= work.entryRoom()) return;
  const std::uint64_t room = std::max(roomFor(entries, work.size.entries), entries);
  for (Buffer* list : {&work.keysA, &work.keysB, &work.valuesA, &work.valuesB}) resize(stage, *list, room * sizeof(uint));
  resize(stage, work.blockSums, blockSumsOf(work.keep.bytes() / sizeof(uint), room) * sizeof(uint));
}

bool RecordRoom::makeRoom(uint queue, std::uint64_t events) {
  if (isEnough_) return true;
  Workspace& work = stage_.work;
  if (!isFirst_) {
    stage_.recorder.submitAndWait();
    const auto counters = work.counters.download<uint>(kCounterCount);
    records_ = counters[kCounterRecords];
    paths_ = counters[queue];
  }
  isFirst_ = false;
  if (records_ + paths_ > work.recordRoom())
    resizeRecords(stage_, std::max(roomFor(records_ + paths_, work.size.records), records_ + paths_), records_);
  isEnough_ = records_ + paths_ * events <= work.recordRoom();
  return paths_ > 0;
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
