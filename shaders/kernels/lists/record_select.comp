#version 460
// Marks the records that belong to a map.
#extension GL_GOOGLE_include_directive : require
#include "bindings/records.glsl"

layout(scalar) writeonly buffer KeepBlock { uint keep[]; };
layout(push_constant, scalar) uniform Push {
  uint source;
  uint mask;
} push;

void main() {
  const uint i = invocationIndex();
  if (i < counters[push.source]) keep[i] = uint((records[i].kind & push.mask) != 0u);
}
