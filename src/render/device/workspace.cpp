#include "render/device/workspace.h"

#include <algorithm>

#include "shared/ray_data.h"

namespace importon {

using gpu::TexelFormat;

std::uint64_t Workspace::blockSumsOf(std::uint64_t compacted, std::uint64_t sorted) {
  const auto tiles = [](std::uint64_t entries) { return (entries + kTileSize - 1) / kTileSize; };
  return std::max(tiles(compacted), tiles(sorted) * kRadix);
}

StandIns::StandIns(gpu::Context& c)
    : guideRows(c, "no guide", sizeof(float), TexelFormat::float1),
      guideColumns(c, "no guide", sizeof(float), TexelFormat::float1),
      environmentGuide(gpu::makeBuffer<uvec4>(c, "no guide", std::vector<uvec4>(1, uvec4(0)), TexelFormat::uint4)),
      scatterGuides(c, "no guide", sizeof(float), TexelFormat::float1),
      samplePlan(c, "no sample plan", sizeof(uvec2), TexelFormat::uint2),
      surfaceCells(c, "no cells of triangles", sizeof(uvec2), TexelFormat::uint2),
      cells(c, "no cells", 2 * sizeof(uvec4), TexelFormat::uint4) {}

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
      lookups(c, "lookups", s.slots * sizeof(uint)),
      standIns(c),
      cells(standIns.noCells()),
      size(s) {
  lightsSeen.clear();
}

}  // namespace importon
