// Each invocation writes its index plus one of four offsets.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer In { uint offsets[]; };
layout(set = 0, binding = 1, scalar) buffer Out { uint results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() {
  const uint index = invocationIndex();
  if (index >= count) return;
  results[index] = index + offsets[index % 4u];
}
