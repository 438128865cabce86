#version 460
// Reads a photon map by the M nearest photons: their flux over the area of the disc that holds them, the sum taken over
// the M-1 inner ones, which removes the bias M/(M-1) of the one that sets the radius. [Jensen 1996; Suykens, talk]
// Run over some levels of the grid at a time, the finest first; lookups that do not find M there are left to the next.
#extension GL_GOOGLE_include_directive : require
#include "bindings/scene.glsl"
#include "bindings/paths.glsl"
#include "bindings/film.glsl"
#include "bindings/photon_light.glsl"

layout(scalar) readonly buffer EyeVerticesBlock { EyeVertex eyeVertices[]; };
layout(push_constant, scalar) uniform Push {
  uint source;
  uint isGlobal;
  uint levels;   // of the grid, a bit each, to look at
  uint isLast;   // of those that the grid has
  uint nearest;  // M
} push;

/// Squared distance of the point at hand, or -1 if it lies on another surface.
float countedDistance(Walk walk, vec3 normal, float radius) {
  const bool isCounted = isInside(walk, normal, radius) && hasLikeNormal(walk.packed, normal, kLikeNormal);
  return isCounted ? dot(walk.offset, walk.offset) : -1.0;
}

#include "lib/neighbourhood.glsl"

/// Light reflected at s towards the path, W/(m² sr).
vec3 reflectedRadiance(Surface s, vec3 direction, Neighbourhood n) {
  const mat3 frame = frameAround(s.shadingNormal);
  const vec3 wo = -direction * frame;
  const Bsdf b = makeBsdf(s, wo.z);
  vec3 sum = vec3(0.0), outer = vec3(0.0);
  float outermost = -1.0;
  restartWalk(n.walk);
  while (nextPoint(n.walk)) {
    const float d2 = countedDistance(n.walk, s.mapNormal, n.radius);
    if (d2 < 0.0 || !isWithin(n.shell, d2)) continue;
    const vec3 light = photonLight(s, b, wo, frame, n.walk.index, n.walk.packed);
    sum += light;
    if (d2 <= outermost) continue;
    outermost = d2;
    outer = light;
  }
  isCut = isCut || isUnfinished(n.walk);
  const bool isDisc = !n.isFull || outermost <= 0.0;  // all that lie within the radius
  const vec3 perArea = isDisc ? sum / (kPi * n.radius * n.radius) : (sum - outer) / (kPi * outermost);
  return float(n.walk.stride) * perArea;
}

void main() {
  const uint i = invocationIndex();
  if (i >= counters[push.source] || push.levels == 0u) return;
  const uint slot = queue[i], flags = paths[slot].flags;
  if ((flags & kPathLookup) == 0u || ((flags & kPathLookupGlobal) != 0u) != (push.isGlobal != 0u)) return;
  const EyeVertex vertex = eyeVertices[slot];
  const Surface s = loadSurface(vertex.triangle, vec2(vertex.u, vertex.v), vertex.direction);
  const Neighbourhood n = findNearest(storedFrame(), s.position, s.mapNormal, push.levels, push.nearest);
  vec3 light = vec3(0.0);
  const bool isDone = n.isFull || n.isLast || push.isLast != 0u;
  if (isDone) light = vertex.throughput * reflectedRadiance(s, vertex.direction, n);
  if (isCut) atomicAdd(counters[kCounterLookupsUnfinished], 1u);
  if (!isDone) return;
  // kPathLookupDeep: the vertex was reached by a gather ray.
  if ((flags & kPathLookupDeep) != 0u) pathLight[slot].indirect += light;
  else pathLight[slot].caustic += light;
  paths[slot].flags = flags & ~kPathLookup;
}
