#version 460
// Reads a photon map by the M nearest photons: their flux over the area of the disc that holds them, the sum taken over
// the M-1 inner ones, which removes the bias M/(M-1) of the one that sets the radius. [Jensen 1996; Suykens, talk]
#extension GL_GOOGLE_include_directive : require
#include "bindings/scene.glsl"
#include "bindings/paths.glsl"
#include "bindings/film.glsl"
#include "bindings/photon_light.glsl"

layout(scalar) readonly buffer EyeVerticesBlock { EyeVertex eyeVertices[]; };
layout(push_constant, scalar) uniform Push {
  uint source;
  uint isGlobal;
  uint levels;   // of the grid, a bit each
  uint nearest;  // M
} push;

/// Squared distance of the point at hand, or -1 if it lies on another surface.
float countedDistance(Walk walk, vec3 normal, float radius) {
  const bool isCounted = isInside(walk, normal, radius) && hasLikeNormal(walk.packed, normal, kLikeNormal);
  return isCounted ? dot(walk.offset, walk.offset) : -1.0;
}

#include "lib/nearest.glsl"

const uint kFinestShift = 15u;  // of the shell: 2^-15 of the squared radius
// In the cells of a level that is searched after finer ones. Some devices end the loops of an invocation after 65,535
// steps in all, without a word; the level that is found is walked over four times.
const uint kMostPoints = 8000u;

uint pointsOf(Walk walk) {
  uint points = 0u;
  for (uint i = 0u; i < walk.ranges; ++i) points += searchRanges[i].y & 0x07FFFFFFu;
  return points;
}

/// A walk over the finest cells that hold M photons around s, so that few more are looked at; false: all hold fewer, or
/// those that might hold M have too many photons, of other surfaces, to look through; the walk is then the last one.
bool findNearest(Surface s, out Walk walk, out float radius, out Shell shell) {
  const GridFrame frame = storedFrame();
  uint levels = push.levels, last = kNone;
  bool isFound = false, isTooMuch = false;
  while (levels != 0u && !isFound) {
    const uint at = uint(findMSB(levels));
    levels ^= 1u << at;
    const float edge = gridCellEdge(frame, at);
    walk = beginWalkLevels(frame, s.position, s.mapNormal, edge, 1u << at);
    isTooMuch = last != kNone && pointsOf(walk) > kMostPoints;
    if (isTooMuch) break;
    last = at;
    radius = edge;
    shell = beginShell(radius);
    isFound = narrow(walk, s.mapNormal, radius, push.nearest, shell);
  }
  if (isTooMuch) {
    walk = beginWalkLevels(frame, s.position, s.mapNormal, radius, 1u << last);
    shell = beginShell(radius);
  }
  while (isFound && shell.between > 1u && shell.shift > kFinestShift)
    narrow(walk, s.mapNormal, radius, push.nearest, shell);
  return isFound;
}

/// Light reflected at s towards the path, W/(m² sr).
vec3 reflectedRadiance(Surface s, vec3 direction) {
  const mat3 frame = frameAround(s.shadingNormal);
  const vec3 wo = -direction * frame;
  const Bsdf b = makeBsdf(s, wo.z);
  Walk walk;
  float radius;
  Shell shell;
  const bool isFull = findNearest(s, walk, radius, shell);
  vec3 sum = vec3(0.0), outer = vec3(0.0);
  float outermost = -1.0;
  restartWalk(walk);
  while (nextPoint(walk)) {
    const float d2 = countedDistance(walk, s.mapNormal, radius);
    if (d2 < 0.0 || !isWithin(shell, d2)) continue;
    const vec3 light = photonLight(s, b, wo, frame, walk.index, walk.packed);
    sum += light;
    if (d2 <= outermost) continue;
    outermost = d2;
    outer = light;
  }
  if (walk.left > 0u || walk.range < walk.ranges) atomicAdd(counters[kCounterLookupsUnfinished], 1u);
  return isFull && outermost > 0.0 ? (sum - outer) / (kPi * outermost) : sum / (kPi * radius * radius);
}

void main() {
  const uint i = invocationIndex();
  if (i >= counters[push.source] || push.levels == 0u) return;
  const uint slot = queue[i], flags = paths[slot].flags;
  if ((flags & kPathLookup) == 0u || ((flags & kPathLookupGlobal) != 0u) != (push.isGlobal != 0u)) return;
  const EyeVertex vertex = eyeVertices[slot];
  const Surface s = loadSurface(vertex.triangle, vec2(vertex.u, vertex.v), vertex.direction);
  const vec3 light = vertex.throughput * reflectedRadiance(s, vertex.direction);
  // kPathLookupDeep: the vertex was reached by a gather ray.
  if ((flags & kPathLookupDeep) != 0u) pathLight[slot].indirect += light;
  else pathLight[slot].caustic += light;
}
