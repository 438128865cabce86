#version 460
// Exclusive prefix sum over block sums by one workgroup of kScanThreads; the total sets a counter.
#extension GL_GOOGLE_include_directive : require
#include "bindings/dispatches.glsl"

layout(scalar) buffer BlockSumsBlock { uint blockSums[]; };
layout(push_constant, scalar) uniform Push {
  uint source;  // counter of the entries
  uint perTile;  // block sums per tile of entries (64 digits in a sort)
  uint target;  // counter that receives the total; kNone: none
  uint accumulate;  // counter that receives `source` on top of its value; kNone: none
} push;

shared uint partial[kScanThreads];

void main() {
  const uint thread = gl_LocalInvocationID.x;
  const uint entries = counters[push.source];
  const uint count = (entries + kTileSize - 1u) / kTileSize * push.perTile;
  const uint perThread = (count + kScanThreads - 1u) / kScanThreads;
  const uint begin = min(thread * perThread, count), end = min(begin + perThread, count);
  uint sum = 0u;
  for (uint i = begin; i < end; ++i) sum += blockSums[i];
  partial[thread] = sum;
  barrier();
  if (thread == 0u) {
    uint running = 0u;
    for (uint i = 0u; i < kScanThreads; ++i) {
      const uint own = partial[i];
      partial[i] = running;
      running += own;
    }
    if (push.accumulate != kNone) setCounter(push.accumulate, counters[push.accumulate] + entries);
    if (push.target != kNone) setCounter(push.target, running);
  }
  barrier();
  uint running = partial[thread];
  for (uint i = begin; i < end; ++i) {
    const uint own = blockSums[i];
    blockSums[i] = running;
    running += own;
  }
}
