#version 460
// Stable compaction, step 1: how many entries of each tile stay.
#extension GL_GOOGLE_include_directive : require
#include "bindings/parameters.glsl"

layout(scalar) readonly buffer KeepBlock { uint keep[]; };
layout(scalar) writeonly buffer BlockSumsBlock { uint blockSums[]; };
layout(push_constant, scalar) uniform Push {
  uint source;
} push;

void main() {
  const uint tile = invocationIndex();
  const uint count = counters[push.source];
  const uint begin = tile * kTileSize;
  if (begin >= count) return;
  const uint end = min(begin + kTileSize, count);
  uint sum = 0u;
  for (uint i = begin; i < end; ++i) sum += keep[i];
  blockSums[tile] = sum;
}
