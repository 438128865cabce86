#version 460
// Stable radix sort, step 3: moves keys and values behind the smaller ones.
#extension GL_GOOGLE_include_directive : require
#include "bindings/parameters.glsl"

layout(scalar) readonly buffer KeysInBlock { uint keysIn[]; };
layout(scalar) readonly buffer ValuesInBlock { uint valuesIn[]; };
layout(scalar) writeonly buffer KeysOutBlock { uint keysOut[]; };
layout(scalar) writeonly buffer ValuesOutBlock { uint valuesOut[]; };
layout(scalar) buffer BlockSumsBlock { uint blockSums[]; };
layout(push_constant, scalar) uniform Push {
  uint source;
  uint shift;
  uint isFirst;
} push;

void main() {
  const uint tile = invocationIndex();
  const uint count = counters[push.source];
  const uint begin = tile * kTileSize;
  if (begin >= count) return;
  const uint end = min(begin + kTileSize, count);
  const uint tiles = (count + kTileSize - 1u) / kTileSize;
  for (uint i = begin; i < end; ++i) {
    const uint key = keysIn[i];
    const uint at = ((key >> push.shift) & (kRadix - 1u)) * tiles + tile;
    const uint target = blockSums[at];
    blockSums[at] = target + 1u;
    keysOut[target] = key;
    valuesOut[target] = push.isFirst != 0u ? i : valuesIn[i];  // the first pass starts from the indices
  }
}
