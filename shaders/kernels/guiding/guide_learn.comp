#version 460
// What photons brought to places that matter, by the cell of the guide that they came from: the second moment of
// flux over the cell, weighted by importance. The best density of samples goes with its root.
#extension GL_GOOGLE_include_directive : require
#include "bindings/guide.glsl"
#include "bindings/site_demand.glsl"
#include "bindings/selection.glsl"
#include "lib/flux.glsl"
#include "lib/photon_stream.glsl"

layout(scalar) buffer GuideSumsBlock { uint sums[]; };  // two words a cell, the low one first
layout(push_constant, scalar) uniform Push {
  uint isGlobal;
  uint stream;
  uint bins;
  float meanImportance;  // pixels/m²
  float hitsPerPass;     // for each hit that was counted at a site; 0: deficits do not matter
  uint isPotential;      // places count in proportion to their importance
} push;

/// Of 64 bits, since the light that counts may be a millionth of the power of all.
void addMoment(uint cell, float moment) {
  const uvec2 units = fixedFromFloat(min(moment, kLargestMoment) * kMomentUnits);
  const uint before = atomicAdd(sums[2u * cell], units.x);
  const uint high = units.y + (before + units.x < before ? 1u : 0u);
  if (high != 0u) atomicAdd(sums[2u * cell + 1u], high);
}

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterSelected]) return;
  const uint at = selection[i];
  const MapPoint point = recordPoints[at];
  MapSettings map = params.causticMap;
  if (push.isGlobal != 0u) map = params.globalMap;
  const uint site = importonAt(importonFrame(), map.importonLevels, point.position, mapPointNormal(point.packed));
  const float importance = site == kNone ? 0.0 : importonImportance(site);
  const uint photon = records[at].kind >> (kRecordRankShift + 5u);
  const vec2 u = sequencePoint(photonStream(push.stream, map, photon), photonIndex(map, photon), kPairDirection);
  const GuidedPoint p = sampleGuide(u, params.lightCount, push.bins);
  const float flux = mean(records[at].flux) * p.density * float(map.photonsPerPass) / params.totalPower;
  float share = weightOfPlace(importance, push.meanImportance, push.isPotential != 0u);
  if (push.hitsPerPass > 0.0 && site != kNone) share *= deficitAt(map, site, push.hitsPerPass);
  const uint first =
      (photon & 1u) * params.lightCount * push.bins * push.bins;  // photons of each half check the other's
  addMoment(first + p.cell, share * flux * flux / p.density);
}
