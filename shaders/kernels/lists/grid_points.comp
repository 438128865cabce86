#version 460
// Copies points into cell order.
#extension GL_GOOGLE_include_directive : require
#include "bindings/parameters.glsl"

layout(binding = kBindingPoints) uniform usamplerBuffer points;
layout(scalar, binding = kBindingValuesIn) readonly buffer ValuesBlock { uint order[]; };
layout(scalar, binding = kBindingPointsOut) writeonly buffer PointsBlock { uvec4 pointsOut[]; };
layout(push_constant, scalar) uniform PushBlock { GridPointsPush push; };

void main() {
  const uint i = invocationIndex();
  if (i < counters[push.source]) pointsOut[i] = texelFetch(points, int(order[i]));
}
