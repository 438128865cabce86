#version 460
// Importance at importons from its M nearest: Γ = Σ Ψ / (π r_M²) over the M-1 inner ones, which removes the
// bias M/(M-1) of counting the one that sets the radius. [Suykens, talk; METHOD]
#extension GL_GOOGLE_include_directive : require
#include "bindings/selection.glsl"
#include "bindings/stored.glsl"
#include "bindings/importance_bound.glsl"
#include "lib/density.glsl"

layout(scalar) readonly buffer StartLevelsBlock { uint startLevels[]; };
uniform samplerBuffer weightsWords;
layout(push_constant, scalar) uniform Push {
  uint levels;
  uint nearest;
} push;

float countedDistance(Walk walk, vec3 normal, float radius) { return likeDistance(walk, normal, radius); }

#include "lib/nearest.glsl"

/// Γ from all importons nearer than `limit` (squared), which becomes that of the disc that was used. `count`: of them.
float importanceWithin(inout Walk walk, vec3 normal, float radius, inout float limit, out uint count) {
  float sum = 0.0, outermost = 0.0, outerWeight = 0.0;
  count = 0u;
  restartWalk(walk);
  while (nextPoint(walk)) {
    const float d2 = likeDistance(walk, normal, radius);
    if (d2 < 0.0 || d2 >= limit) continue;
    const float weight = texelFetch(weightsWords, int(walk.index)).x;
    sum += weight;
    ++count;
    if (d2 >= outermost) {
      outermost = d2;
      outerWeight = weight;
    }
  }
  if (isCut || isUnfinished(walk)) atomicAdd(counters[kCounterLookupsUnfinished], 1u);
  const float stride = float(walk.stride);
  if (count < 3u || outermost <= 0.0) return stride * sum / (kPi * limit);
  limit = outermost;
  return stride * (sum - outerWeight) / (kPi * outermost);
}

void main() {
  const uint site = invocationIndex();
  if (site >= counters[kCounterSites]) return;
  const uint i = site * kImportonsPerSite;
  const MapPoint point = recordPoints[selection[i]];
  const vec3 normal = mapPointNormal(point.packed);
  const GridFrame frame = storedFrame();
  // From the start level on to coarser ones: its count may have been that of other cells in the same slot.
  uint levels = push.levels & ((2u << startLevels[i]) - 1u), count;
  const uint first = 1u << uint(findMSB(levels)), most = mostPointsOf(push.levels);
  Walk walk;
  float radius, limit, importance;
  bool isSettled;
  do {
    isSettled = levels == first;  // none but this level
    Shell shell;
    bool isFound = false;
    while (levels != 0u && !isFound) {
      const uint level = uint(findMSB(levels));
      levels ^= 1u << level;
      radius = gridCellEdge(frame, level);
      shell = beginShell(radius);
      walk = beginWalkLevels(frame, point.position, normal, radius, 1u << level);
      thin(walk, most);
      isFound = narrow(walk, normal, radius, push.nearest, shell);
      if (isFound) narrow(walk, normal, radius, push.nearest, shell);
    }
    limit = isFound ? shellLimit(shell) : radius * radius;
    importance = importanceWithin(walk, normal, radius, limit, count);
    levels = first;
    // A lone site whose neighbours were thinned away settles for those that its first level has: at least itself.
  } while (walk.stride > 1u && count < 3u && !isSettled);
  required[site] = importance;
  if (kImportanceBound != kBoundNone) bounds[site] = limit;  // for importon_bound.comp
}
