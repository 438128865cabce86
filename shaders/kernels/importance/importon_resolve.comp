#version 460
// Importance in cell order.
#extension GL_GOOGLE_include_directive : require
#include "bindings/selection.glsl"

layout(scalar) readonly buffer OrderBlock { uint order[]; };
layout(scalar) writeonly buffer ImportanceBlock { float importance[]; };

void main() {
  const uint i = invocationIndex();
  if (i < counters[kCounterSites]) importance[i] = required[order[i]];
}
