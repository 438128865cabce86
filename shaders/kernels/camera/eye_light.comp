#version 460
// Adds the direct light of shadow rays that met nothing.
#extension GL_GOOGLE_include_directive : require
#include "bindings/paths.glsl"
#include "bindings/film.glsl"

layout(scalar) readonly buffer ShadowRaysBlock { Ray shadowRays[]; };
layout(scalar) readonly buffer ShadowLightBlock { vec3 shadowLight[]; };
layout(push_constant, scalar) uniform Push {
  uint source;
} push;

void main() {
  const uint i = invocationIndex();
  if (i >= counters[push.source]) return;
  const uint slot = queue[i];
  if (!(shadowRays[slot].tMax > 0.0) || hitAt(slot).triangle != kNone) return;
  if ((paths[slot].flags & kPathShadowDeep) != 0u) pathLight[slot].indirect += shadowLight[slot];
  else pathLight[slot].direct += shadowLight[slot];
}
