#version 460
// Importance, required density and density of the map at work, at the surface in the middle of each pixel.
#extension GL_GOOGLE_include_directive : require
#include "bindings/scene.glsl"
#include "bindings/paths.glsl"
#include "bindings/importance.glsl"
#include "bindings/stored.glsl"

layout(scalar) writeonly buffer AovBlock { float aov[]; };
layout(push_constant, scalar) uniform Push {
  uint count;
  uint isGlobal;
  uint levels;  // counter with the map's grid levels
} push;

/// Photons per m² within the lookup radius.
float storedDensity(vec3 position, vec3 normal, float radius) {
  uint count = 0u;
  Walk walk = beginWalk(storedFrame(), counters[push.levels], position, normal, radius, radius);
  while (nextPoint(walk))
    if (isInside(walk, normal, radius) && hasLikeNormal(walk.packed, normal, kLikeNormal)) ++count;
  return float(count) / (kPi * radius * radius);
}

void main() {
  const uint slot = invocationIndex();
  if (slot >= push.count) return;
  const Ray ray = rayAt(slot);
  const Hit hit = hitAt(slot);
  if (hit.triangle == kNone) return;
  const Surface s = loadSurface(hit.triangle, vec2(hit.u, hit.v), ray.direction);
  MapSettings map = params.causticMap;
  if (push.isGlobal != 0u) map = params.globalMap;
  const float required = requiredDensity(map, s.position, s.mapNormal);
  const uint base = kAovFloats * slot + push.isGlobal;
  aov[base + kAovImportance] = importanceAt(map, s.position, s.mapNormal);
  aov[base + kAovRequired] = required;
  aov[base + kAovDensity] = storedDensity(s.position, s.mapNormal,
                                          lookupRadius(map, lookupDensity(map, s.position, s.mapNormal)));
}
