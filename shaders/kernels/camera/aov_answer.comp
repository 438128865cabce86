#version 460
// Takes what the lookup that aov_ask asked for has brought.
#extension GL_GOOGLE_include_directive : require
#include "bindings/film.glsl"

layout(scalar) writeonly buffer AovBlock { float aov[]; };
layout(push_constant, scalar) uniform Push {
  uint count;     // pixels of the tile
  uint isGlobal;
} push;

void main() {
  const uint slot = invocationIndex();
  if (slot >= push.count) return;
  const uint base = kAovFloats * slot + kAovMapLight + 3u * push.isGlobal;
  for (uint c = 0u; c < 3u; ++c) aov[base + c] = pathLight[slot].caustic[c];
}
