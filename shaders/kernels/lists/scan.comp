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

// Sixteen words in each turn of a loop: some devices end the loops of an invocation after 65,535 turns in all, without
// a word, which the block sums of a sort of a few million entries would reach.
const uint kPerTurn = 16u;

uint wordAt(uint i, uint end) { return i < end ? blockSums[i] : 0u; }
uint sumOfFour(uint i, uint end) {
  return wordAt(i, end) + wordAt(i + 1u, end) + wordAt(i + 2u, end) + wordAt(i + 3u, end);
}
uint sumOfTurn(uint i, uint end) {
  return sumOfFour(i, end) + sumOfFour(i + 4u, end) + sumOfFour(i + 8u, end) + sumOfFour(i + 12u, end);
}

/// Replaces a word by the sum of those before it.
void replaceWord(uint i, uint end, inout uint running) {
  if (i >= end) return;
  const uint own = blockSums[i];
  blockSums[i] = running;
  running += own;
}
void replaceFour(uint i, uint end, inout uint running) {
  replaceWord(i, end, running);
  replaceWord(i + 1u, end, running);
  replaceWord(i + 2u, end, running);
  replaceWord(i + 3u, end, running);
}
void replaceTurn(uint i, uint end, inout uint running) {
  replaceFour(i, end, running);
  replaceFour(i + 4u, end, running);
  replaceFour(i + 8u, end, running);
  replaceFour(i + 12u, end, running);
}

void main() {
  const uint thread = gl_LocalInvocationID.x;
  const uint entries = counters[push.source];
  const uint count = (entries + kTileSize - 1u) / kTileSize * push.perTile;
  const uint perThread = (count + kScanThreads - 1u) / kScanThreads;
  const uint begin = min(thread * perThread, count), end = min(begin + perThread, count);
  uint sum = 0u;
  for (uint i = begin; i < end; i += kPerTurn) sum += sumOfTurn(i, end);
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
  for (uint i = begin; i < end; i += kPerTurn) replaceTurn(i, end, running);
}
