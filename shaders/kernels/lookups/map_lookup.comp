#version 460
// Reads a photon map where eye paths asked for it: reflected radiance by density estimation. [Jensen 1996]
#extension GL_GOOGLE_include_directive : require
#include "bindings/scene.glsl"
#include "bindings/paths.glsl"
#include "bindings/film.glsl"
#include "bindings/importance.glsl"
#include "bindings/photon_light.glsl"

layout(scalar) readonly buffer EyeVerticesBlock { EyeVertex eyeVertices[]; };
layout(push_constant, scalar) uniform Push {
  uint source;
  uint isGlobal;
  uint levels;  // counter with the map's grid levels
} push;

const uint kMostPoints = 12000u;  // of the cells of a lookup

/// What one photon adds to the radiance.
vec3 photonContribution(Surface s, Bsdf b, vec3 wo, mat3 frame, uint photon, float radius) {
  const uvec4 point = gridPoint(photon);
  const vec3 offset = uintBitsToFloat(point.xyz) - s.position;
  if (!hasLikeNormal(point.w, s.mapNormal, kLikeNormal)) return vec3(0.0);
  return photonLight(s, b, wo, frame, photon, point.w) * epanechnikov(dot(offset, offset), radius);
}

/// Light reflected at s towards the path, W/(m² sr).
vec3 reflectedRadiance(Surface s, vec3 direction, float radius, bool isRest) {
  const mat3 frame = frameAround(s.shadingNormal);
  const vec3 wo = -direction * frame;
  Bsdf b = makeBsdf(s, wo.z);
  float left;
  if (kHasReflection && isRest) removeDiffuse(b, wo.z, left);
  vec3 sum = vec3(0.0);
  Walk walk = beginWalk(storedFrame(), counters[push.levels], s.position, s.mapNormal, radius, radius);
  thin(walk, kMostPoints);
  bool isDone = false;
  while (!isDone) {
    const uint count = collectFound(walk, s.mapNormal, radius, isDone);
    for (uint k = 0u; k < count; ++k) sum += photonContribution(s, b, wo, frame, foundPoints[k], radius);
  }
  if (isUnfinished(walk)) atomicAdd(counters[kCounterLookupsUnfinished], 1u);
  return float(walk.stride) * sum;
}

void main() {
  const uint i = invocationIndex();
  if (i >= counters[push.source] || counters[push.levels] == 0u) return;
  const uint slot = queue[i];
  const uint flags = paths[slot].flags;
  if ((flags & kPathLookup) == 0u || ((flags & kPathLookupGlobal) != 0u) != (push.isGlobal != 0u)) return;
  const EyeVertex vertex = eyeVertices[slot];
  const Surface s = loadSurface(vertex.triangle, vec2(vertex.u, vertex.v), vertex.direction);
  float radius = vertex.radius;
  if (radius <= 0.0) {
    MapSettings map = params.causticMap;
    if (push.isGlobal != 0u) map = params.globalMap;
    radius = lookupRadius(map, lookupDensity(map, s.position, s.mapNormal));
  }
  const vec3 light =
      vertex.throughput * reflectedRadiance(s, vertex.direction, radius, (flags & kPathLookupRest) != 0u);
  // kPathLookupDeep: the vertex was reached by a gather ray.
  if ((flags & kPathLookupDeep) != 0u) pathLight[slot].indirect += light;
  else pathLight[slot].caustic += light;
}
