#version 460
// Irradiance of a finished map at points of its surfaces, photons or importons, so that lookups need only read the
// nearest one. [Christensen 1999]
#extension GL_GOOGLE_include_directive : require
#include "bindings/importance.glsl"
#include "bindings/stored.glsl"
#include "lib/flux.glsl"

uniform usamplerBuffer mapFluxPairs;
uniform usamplerBuffer pointsTexels;
layout(scalar) writeonly buffer IrradianceBlock { uvec2 irradiance[]; };
layout(push_constant, scalar) uniform Push {
  uint count;
  uint isGlobal;
  uint arePhotons;
  uint levels;  // counter with the map's grid levels
} push;

void main() {
  const uint i = invocationIndex();
  if (i >= push.count || (push.arePhotons != 0u && i >= counters[kCounterStored])) return;
  const uvec4 point = texelFetch(pointsTexels, int(i));
  const vec3 position = uintBitsToFloat(point.xyz), normal = mapPointNormal(point.w);
  MapSettings map = params.causticMap;
  if (push.isGlobal != 0u) map = params.globalMap;
  const float radius = lookupRadius(map, lookupDensity(map, position, normal));
  Walk walk = beginWalk(storedFrame(), counters[push.levels], position, normal, radius, radius);
  vec3 sum = vec3(0.0);
  while (nextPoint(walk)) {
    if (!isInside(walk, normal, radius) || !hasLikeNormal(walk.packed, normal, kLikeNormal)) continue;
    const vec3 flux = unpackFlux(texelFetch(mapFluxPairs, int(walk.index)).xy);
    sum += flux * epanechnikov(dot(walk.offset, walk.offset), radius);
  }
  irradiance[i] = packFlux(sum);
}
