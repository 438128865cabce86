#version 460
// Importance, required density and density of lit cells of the irradiance map, at the surface in the middle of each
// pixel.
#extension GL_GOOGLE_include_directive : require
#include "bindings/scene.glsl"
#include "bindings/paths.glsl"
#include "bindings/importance.glsl"
#include "bindings/irradiance.glsl"

uniform usamplerBuffer cellSumsTexels;
uniform usamplerBuffer cellPlacesPairs;
layout(scalar) writeonly buffer AovBlock { float aov[]; };
layout(push_constant, scalar) uniform Push {
  uint count;
} push;

void main() {
  const uint slot = invocationIndex();
  if (slot >= push.count) return;
  const Ray ray = rayAt(slot);
  const Hit hit = hitAt(slot);
  if (hit.triangle == kNone) return;
  const Surface s = loadSurface(hit.triangle, vec2(hit.u, hit.v), ray.direction);
  const uint side = cellSide(hit.triangle, vec2(hit.u, hit.v), s.isFront);
  const uint base = kAovFloats * slot + 1u;
  const float area = uintBitsToFloat(texelFetch(cellPlacesPairs, int(side / 2u)).y);
  aov[base + kAovImportance] = importanceAt(params.globalMap, s.position, s.mapNormal);
  aov[base + kAovRequired] = requiredDensity(params.globalMap, s.position, s.mapNormal);
  aov[base + kAovDensity] = texelFetch(cellSumsTexels, int(2u * side + 1u)).z > 0u ? 1.0 / max(area, 1e-30) : 0.0;
}
