#version 460
// Stable compaction, step 3: writes the entries that stay, in their order.
#extension GL_GOOGLE_include_directive : require
#include "bindings/parameters.glsl"

layout(scalar) readonly buffer KeepBlock { uint keep[]; };
layout(scalar) readonly buffer BlockSumsBlock { uint blockSums[]; };
layout(scalar) readonly buffer QueueBlock { uint queue[]; };
layout(scalar) writeonly buffer NextQueueBlock { uint nextQueue[]; };
layout(push_constant, scalar) uniform Push {
  uint source;
  uint takesIndex;  // 1: writes the index of an entry; 0: the queue's value there
} push;

void main() {
  const uint tile = invocationIndex();
  const uint count = counters[push.source];
  const uint begin = tile * kTileSize;
  if (begin >= count) return;
  const uint end = min(begin + kTileSize, count);
  uint target = blockSums[tile];
  for (uint i = begin; i < end; ++i) {
    if (keep[i] == 0u) continue;
    nextQueue[target++] = push.takesIndex != 0u ? i : queue[i];
  }
}
