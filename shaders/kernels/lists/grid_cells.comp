#version 460
// First and end of every slot's run in the sorted keys. The cells were cleared to empty ranges.
#extension GL_GOOGLE_include_directive : require
#include "bindings/parameters.glsl"

layout(scalar) readonly buffer KeysBlock { uint keys[]; };
layout(scalar) writeonly buffer CellsBlock { uvec2 cells[]; };
layout(push_constant, scalar) uniform Push {
  uint source;
  uint slotMask;
} push;

void main() {
  const uint i = invocationIndex();
  const uint count = counters[push.source];
  if (i >= count) return;
  const uint key = keys[i];
  if (key > push.slotMask) return;  // entries without a cell sort behind all slots
  if (i == 0u || keys[i - 1u] != key) cells[key].x = i;
  if (i + 1u == count || keys[i + 1u] != key) cells[key].y = i + 1u;
}
