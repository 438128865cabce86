// Another default for the workgroup size, and shared memory of that size.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"
layout(local_size_x = 128) in;

layout(set = 0, binding = 1, scalar) writeonly buffer Out { uint results[]; };

shared uint items[gl_WorkGroupSize.x];

void main() {
  items[gl_LocalInvocationIndex] = gl_LocalInvocationIndex;
  barrier();
  results[invocationIndex()] = items[gl_WorkGroupSize.x - 1u - gl_LocalInvocationIndex];
}
