// Emission from the environment by its guide.
#ifndef IMPORTON_BINDINGS_ENVIRONMENT_GUIDE_GLSL
#define IMPORTON_BINDINGS_ENVIRONMENT_GUIDE_GLSL
#include "bindings/lights.glsl"
#include "lib/environment_guide.glsl"

uniform usamplerBuffer environmentGuideTexels;

uvec4 escapeTexel(uint i) { return texelFetch(environmentGuideTexels, int(i)); }

/// 0: photons of the environment go by its radiance alone.
uint escapeLeaves() { return escapeTexel(0u).w; }

uint escapeLevelUp(uint level) { return min(level * kEscapeStep, uint(findMSB(escapeLeaves()))); }

vec4 escapeBoxLow(uint node) { return uintBitsToFloat(escapeTexel(3u * node)); }
vec4 escapeBoxSize(uint node) { return uintBitsToFloat(escapeTexel(3u * node + 1u)); }

/// Density of the guided photons at a ray's coordinates, 1/(m² sr), times their share.
float guidedDensity(vec4 at) {
  const uint leaves = escapeLeaves();
  uint node = 1u;
  while (node < leaves) {
    const uvec4 split = escapeTexel(3u * node + 2u);
    node = 2u * node + (at[split.y] < uintBitsToFloat(split.x) ? 0u : 1u);
  }
  float density = 0.0, share = kEscapeShare;
  for (uint level = 0u; level < kEscapeLevels; ++level, share *= 0.5) {
    const uint up = escapeLevelUp(level);
    const vec4 inside = at - escapeBoxLow(node >> up), size = escapeBoxSize(node >> up);
    const bool isIn = all(greaterThanEqual(inside, vec4(0.0))) && all(lessThanEqual(inside, size));
    if (isIn) density += share / (4.0 * kPi * float(leaves >> up) * size.x * size.y * size.z * size.w);
  }
  return density;
}

/// Coordinates of a guided ray: a level, one of its boxes, a place in it. `u`: below kGuidedEscapes.
vec4 sampleEscape(float u, vec3 v) {
  uint level = 0u;
  float share = kEscapeShare;
  while (u >= share && level + 1u < kEscapeLevels) {
    u -= share;
    share *= 0.5;
    ++level;
  }
  const uint boxes = escapeLeaves() >> escapeLevelUp(level);
  const float scaled = min(u / share, 0.99999994) * float(boxes);
  const uint box = min(uint(scaled), boxes - 1u);
  return escapeBoxLow(boxes + box) + vec4(v, min(scaled - float(box), 0.99999994)) * escapeBoxSize(boxes + box);
}

/// A photon of the environment: kGuidedEscapes of them by the guide, the others by radiance, from anywhere; each weighs
/// by the density of both together. [Veach 1997, the one-sample model of multiple importance sampling]
Emission emitFromEnvironment(vec2 place, vec2 u, vec3 sceneCentre, float sceneRadius) {
  const vec3 centre = uintBitsToFloat(escapeTexel(0u).xyz);
  vec3 toSky, point;
  vec4 at;
  if (u.y < kGuidedEscapes) {
    at = sampleEscape(u.y, vec3(place, u.x));
    toSky = escapeDirection(at.xy);
    point = centre + frameAround(-toSky) * vec3(at.zw, 0.0);
  } else {
    float pdf;
    toSky = sampleEnvironment(vec2(u.x, min((u.y - kGuidedEscapes) / (1.0 - kGuidedEscapes), 0.99999994)), pdf);
    const mat3 frame = frameAround(-toSky);
    point = sceneCentre + frame * vec3(sampleDisc(place) * sceneRadius, 0.0);
    at = vec4(escapePlace(toSky), ((point - centre) * frame).xy);
  }
  const vec3 fromCentre = point - sceneCentre, direction = -toSky;
  const float along = dot(fromCentre, direction);
  const vec3 across = fromCentre - along * direction;
  const bool isOnDisc = dot(across, across) <= sceneRadius * sceneRadius;
  const float byRadiance = isOnDisc ? pdfEnvironment(toSky) / (kPi * sceneRadius * sceneRadius) : 0.0;
  Emission e;
  e.direction = direction;
  e.origin = point - (along + sceneRadius) * direction;
  e.flux = environmentRadiance(toSky) / max(guidedDensity(at) + (1.0 - kGuidedEscapes) * byRadiance, 1e-30);
  return e;
}

#endif
