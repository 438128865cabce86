#version 460
// Keeps each hit of the map at work with the probability D_r / D_expected, and notes the weight 1/p of its power.
// Counts the hits near each importon, for the passes to come. [Keller and Wald 2000]
#extension GL_GOOGLE_include_directive : require
#include "bindings/expected.glsl"
#include "bindings/selection.glsl"

layout(scalar) buffer ImportonHitsBlock { uint hitsOut[]; };
layout(push_constant, scalar) uniform Push {
  uint isGlobal;
  float floorProbability;
} push;

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterSelected]) return;
  const MapPoint point = recordPoints[selection[i]];
  const vec3 normal = mapPointNormal(point.packed);
  MapSettings map = params.causticMap;
  if (push.isGlobal != 0u) map = params.globalMap;
  const NearImportons importons = importonsAt(importonFrame(), map.importonLevels, point.position, normal);
  if (importons.nearest != kNone && params.pass < kCountingPasses) atomicAdd(hitsOut[importons.nearest], 1u);
  const float density = requiredDensityAt(map, importons.first);
  float area;
  const uint hits = pilotHits(expectedCell(point.position, normal, density / params.densityScale, area));
  const float probability = storageProbability(density, area, hits, push.floorProbability);
  const uint rank = records[selection[i]].kind >> kRecordRankShift;
  const float u =
      unitFloat(hashCombine(hashCombine(params.seed, kStreamStorage + push.isGlobal), hashCombine(params.pass, rank)));
  keep[i] = uint(u < probability);
  required[i] = 1.0 / probability;
  selectedPoints[i] = point;
}
