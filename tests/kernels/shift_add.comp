// Takes each item from the neighbour and adds a step, so a chain of dispatches needs all of the one before.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer In { uint items[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { uint results[]; };
layout(push_constant, scalar) uniform Push { uint count; uint stride; };

void main() {
  const uint index = invocationIndex();
  if (index < count) results[index] = items[(index + 1u) % count] + stride;
}
