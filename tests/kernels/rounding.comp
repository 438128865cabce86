// Quotients and roots of lib/rounding.glsl from estimates that are off: see rounding_test.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"
#include "lib/rounding.glsl"

struct Query {
  float a, b;
  int off;  // units in the last place
};

layout(set = 0, binding = 0, scalar) readonly buffer In { Query items[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { vec2 results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

float estimate(float x, int off) { return uintBitsToFloat(uint(int(floatBitsToUint(x)) + off)); }

void main() {
  const uint index = invocationIndex();
  if (index >= count) return;
  const Query q = items[index];
  const float ratio = estimate(float(significandOf(q.a)) / float(significandOf(q.b)), q.off);
  const float root = estimate(sqrt(radicandOf(abs(q.a))), q.off);
  results[index] = vec2(quotientNear(q.a, q.b, ratio), rootNear(abs(q.a), root));
}
