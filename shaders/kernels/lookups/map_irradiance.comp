#version 460
// Reads precomputed irradiance where eye paths asked for a map lookup on a surface that reflects nearly by Lambert's
// law: that of the nearest photon or importon. Other lookups, and those without one near, are left to map_lookup.
// [Christensen 1999]
#extension GL_GOOGLE_include_directive : require
#include "bindings/scene.glsl"
#include "bindings/paths.glsl"
#include "bindings/film.glsl"
#include "bindings/importance.glsl"
#include "bindings/stored.glsl"
#include "lib/bsdf.glsl"
#include "lib/flux.glsl"

layout(scalar) readonly buffer EyeVerticesBlock { EyeVertex eyeVertices[]; };
uniform usamplerBuffer irradiancePairs;
layout(push_constant, scalar) uniform Push {
  uint source;
  uint isGlobal;
  uint arePhotons;
  uint levels;  // counter with the map's grid levels
} push;

/// The nearest photon within the lookup radius; kNone: there is none.
uint nearestPhoton(Surface s, float radius) {
  Walk walk = beginWalk(storedFrame(), counters[push.levels], s.position, s.mapNormal, radius, radius);
  uint nearest = kNone;
  float least = kInfinity;
  while (nextPoint(walk)) {
    const float d2 = dot(walk.offset, walk.offset);
    if (d2 >= least || !isInside(walk, s.mapNormal, radius)) continue;
    if (!hasLikeNormal(walk.packed, s.mapNormal, kLikeNormal)) continue;
    least = d2;
    nearest = walk.index;
  }
  return nearest;
}

/// The nearest importon of the finest cell around s; kNone: there is none.
uint nearestSite(MapSettings map, Surface s) {
  return importonAt(importonFrame(), map.importonLevels, s.position, s.mapNormal);
}

void main() {
  const uint i = invocationIndex();
  if (i >= counters[push.source] || counters[push.levels] == 0u) return;
  const uint slot = queue[i];
  const uint flags = paths[slot].flags;
  if ((flags & kPathLookup) == 0u || ((flags & kPathLookupGlobal) != 0u) != (push.isGlobal != 0u)) return;
  const EyeVertex vertex = eyeVertices[slot];
  const Surface s = loadSurface(vertex.triangle, vec2(vertex.u, vertex.v), vertex.direction);
  const mat3 frame = frameAround(s.shadingNormal);
  const vec3 wo = -vertex.direction * frame;
  const Bsdf b = makeBsdf(s, wo.z);
  if (isGlossy(b)) return;
  MapSettings map = params.causticMap;
  if (push.isGlobal != 0u) map = params.globalMap;
  uint at;
  if (push.arePhotons != 0u)
    at = nearestPhoton(s, lookupRadius(map, lookupDensity(map, s.position, s.mapNormal)));
  else at = nearestSite(map, s);
  if (at == kNone) return;
  float pdf;
  const vec3 reflectance = evalBsdf(b, wo, vec3(0.0, 0.0, 1.0), pdf);  // its cosine is 1
  const vec3 light = vertex.throughput * reflectance * unpackFlux(texelFetch(irradiancePairs, int(at)).xy);
  if ((flags & kPathLookupDeep) != 0u) pathLight[slot].indirect += light;
  else pathLight[slot].caustic += light;
  paths[slot].flags = flags & ~kPathLookup;
}
