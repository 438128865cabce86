#version 460
// What the middle of each pixel shows: the surface there.
#extension GL_GOOGLE_include_directive : require
#include "bindings/scene.glsl"
#include "bindings/paths.glsl"
#include "lib/bsdf.glsl"

layout(scalar) writeonly buffer AovBlock { float aov[]; };
layout(push_constant, scalar) uniform Push {
  uint count;  // pixels of the tile
} push;

void writeColor(uint at, vec3 color) {
  for (uint c = 0u; c < 3u; ++c) aov[at + c] = color[c];
}

void main() {
  const uint slot = invocationIndex();
  if (slot >= push.count) return;
  const uint base = kAovFloats * slot;
  for (uint k = 0u; k < kAovFloats; ++k) aov[base + k] = 0.0;
  const Ray ray = rayAt(slot);
  const Hit hit = hitAt(slot);
  aov[base + kAovDepth] = hit.triangle == kNone ? kInfinity : hit.t;
  if (hit.triangle == kNone) return;
  const Surface s = loadSurface(hit.triangle, vec2(hit.u, hit.v), ray.direction);
  writeColor(base + kAovAlbedo, s.baseColor);
  writeColor(base + kAovNormal, s.shadingNormal);
  writeColor(base + kAovPosition, s.position);
  if (s.canEmit) writeColor(base + kAovEmission, s.emission);
}
