#version 460
// Sets a counter and its dispatch arguments: value + counters[a] + counters[b], up to a limit.
#extension GL_GOOGLE_include_directive : require
#include "bindings/dispatches.glsl"

layout(push_constant, scalar) uniform Push {
  uint counter;
  uint value;
  uint a;      // kNone: nothing is added
  uint b;
  uint limit;  // the counter stays at or below it
} push;

void main() {
  if (invocationIndex() != 0u) return;
  uint value = push.value;
  if (push.a != kNone) value += counters[push.a];
  if (push.b != kNone) value += counters[push.b];
  setCounter(push.counter, min(value, push.limit));
}
