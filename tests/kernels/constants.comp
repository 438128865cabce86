// Writes its specialization constants and workgroup size.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"

layout(constant_id = 1) const uint kCount = 11u;
layout(constant_id = 2) const float kScale = 0.5;
layout(constant_id = 3) const bool kHasIt = false;

layout(set = 0, binding = 1, scalar) writeonly buffer Out { uint results[4]; };

void main() {
  if (invocationIndex() != 0u) return;
  results[0] = gl_WorkGroupSize.x;
  results[1] = kCount;
  results[2] = floatBitsToUint(kScale);
  results[3] = uint(kHasIt);
}
