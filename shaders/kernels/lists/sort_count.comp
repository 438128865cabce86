#version 460
// Stable radix sort, step 1: how often each digit occurs in each tile; blockSums[digit][tile].
#extension GL_GOOGLE_include_directive : require
#include "bindings/parameters.glsl"

layout(scalar) readonly buffer KeysBlock { uint keys[]; };
layout(scalar) buffer BlockSumsBlock { uint blockSums[]; };
layout(push_constant, scalar) uniform Push {
  uint source;
  uint shift;
} push;

void main() {
  const uint tile = invocationIndex();
  const uint count = counters[push.source];
  const uint begin = tile * kTileSize;
  if (begin >= count) return;
  const uint end = min(begin + kTileSize, count);
  const uint tiles = (count + kTileSize - 1u) / kTileSize;
  for (uint digit = 0u; digit < kRadix; ++digit) blockSums[digit * tiles + tile] = 0u;
  for (uint i = begin; i < end; ++i) ++blockSums[((keys[i] >> push.shift) & (kRadix - 1u)) * tiles + tile];
}
