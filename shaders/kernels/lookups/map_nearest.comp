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

/// A walk over the finest cells that hold M photons around s, so that few more are looked at; false: all hold fewer, and
/// the walk is that over the coarsest.
bool findNearest(Surface s, out Walk walk, out float radius, out Shell shell) {
  const GridFrame frame = storedFrame();
  const uint mostPoints = mostPointsOf(push.levels);
  uint levels = push.levels;
  bool isFound = false;
  while (levels != 0u && !isFound) {
    const uint level = uint(findMSB(levels));
    levels ^= 1u << level;
    radius = gridCellEdge(frame, level);
    walk = beginWalkLevels(frame, s.position, s.mapNormal, radius, 1u << level);
    thin(walk, mostPoints);
    shell = beginShell(radius);
    isFound = narrow(walk, s.mapNormal, radius, push.nearest, shell);
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
  while (nextTaken(walk)) {
    const float d2 = countedDistance(walk, s.mapNormal, radius);
    if (d2 < 0.0 || !isWithin(shell, d2)) continue;
    const vec3 light = photonLight(s, b, wo, frame, walk.index, walk.packed);
    sum += light;
    if (d2 <= outermost) continue;
    outermost = d2;
    outer = light;
  }
  if (isUnfinished(walk)) atomicAdd(counters[kCounterLookupsUnfinished], 1u);
  const vec3 perArea = isFull && outermost > 0.0 ? (sum - outer) / (kPi * outermost) : sum / (kPi * radius * radius);
  return float(walk.stride) * perArea;
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
