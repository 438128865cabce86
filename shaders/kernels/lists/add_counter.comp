#version 460
// Adds a counter to a sum of two words.
#extension GL_GOOGLE_include_directive : require
#include "bindings/parameters.glsl"

layout(push_constant, scalar) uniform Push {
  uint counter;
  uint sum;      // its low word; the high one follows
  uint empties;  // 1: the counter is 0 afterwards
} push;

void main() {
  if (invocationIndex() != 0u) return;
  const uint before = counters[push.sum], added = counters[push.counter];
  counters[push.sum] = before + added;
  counters[push.sum + 1u] += uint(before + added < before);
  if (push.empties != 0u) counters[push.counter] = 0u;
}
