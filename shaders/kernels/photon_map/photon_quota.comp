#version 460
// The rank quota: a hit is stored if fewer than Q photons lie within its quota radius, counting those already
// stored and the hits of the batch that come before it; or with a probability that falls as a cosine with that count
// [Suykens and Willems 2000]. The order of threads does not matter. Run over the grid of stored photons first
// (isBatch = 0), then over the grid of the batch's hits.
#extension GL_GOOGLE_include_directive : require
#include "bindings/importance.glsl"
#include "bindings/selection.glsl"
#include "bindings/stored.glsl"
#include "shared/elementary.h"

layout(scalar) readonly buffer OrderBlock { uint batchOrder[]; };
layout(scalar) buffer NeighboursBlock { uint neighbours[]; };
layout(push_constant, scalar) uniform Push {
  uint isBatch;
  uint hasStored;
  uint acceptance;  // kAccept*
  uint fewest;      // up to so many neighbours do not count
} push;

/// Counts from where the walk stands, up to the quota.
uint countNeighbours(Walk walk, vec3 normal, float radius, uint quota, uint i, uint count) {
  while (count < quota && nextPoint(walk)) {
    if (!isInside(walk, normal, radius)) continue;
    // Later hits follow.
    if (push.isBatch != 0u && texelFetch(storedOrderWords, int(walk.index)).x >= i) skipRange(walk);
    else if (hasLikeNormal(walk.packed, normal, kLikeNormal)) ++count;
  }
  return count;
}

/// A uniform number in [0, 1) of the hit's own.
float chance(uint i) {
  const uint rank = records[selection[i]].kind >> kRecordRankShift;
  return unitFloat(hashCombine(hashCombine(params.seed, kStreamStorage), hashCombine(params.pass, rank)));
}

bool isAccepted(uint count, float quota, uint i) {
  if (count <= push.fewest) return true;
  if (push.acceptance == kAcceptStep) return float(count) < quota;
  return chance(i) < 0.5 + 0.5 * portableCos(kPi * min(float(count) / quota, 1.0));
}

void main() {
  const uint j = invocationIndex();
  if (j >= counters[kCounterSelected]) return;
  const uint i = batchOrder[j];  // hits of one cell side by side
  const MapPoint point = selectedPoints[i];
  const vec3 normal = mapPointNormal(point.packed);
  const float radius = quotaRadius(required[i]);
  const float share = quotaAt(required[i], radius);
  const uint quota = max(uint(ceil(share - 0.001)), push.fewest + 1u);  // count so far
  const uint before = push.isBatch != 0u && push.hasStored != 0u ? neighbours[i] : 0u;
  const uint levels = counters[push.isBatch != 0u ? kCounterLevels : kCounterStoredLevels];
  const GridFrame frame = storedFrame();
  // Where light is plentiful the own cell is enough to reject.
  uint count = countNeighbours(beginWalkCell(frame, point.position, mapPointLevel(point.packed)), normal, radius, quota,
                               i, before);
  if (count < quota)
    count = countNeighbours(beginWalk(frame, levels, point.position, normal, radius, radius), normal, radius, quota, i,
                            before);
  neighbours[i] = count;
  keep[i] = uint(isAccepted(count, share, i));
}
