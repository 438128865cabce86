#version 460
// Copies points into cell order.
#extension GL_GOOGLE_include_directive : require
#include "bindings/parameters.glsl"

uniform usamplerBuffer pointsTexels;
layout(scalar) readonly buffer OrderBlock { uint order[]; };
layout(scalar) writeonly buffer PointsOutBlock { uvec4 pointsOut[]; };
layout(push_constant, scalar) uniform Push {
  uint source;
} push;

void main() {
  const uint i = invocationIndex();
  if (i < counters[push.source]) pointsOut[i] = texelFetch(pointsTexels, int(order[i]));
}
