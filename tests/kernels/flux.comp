// Fixed-point flux and packed flux.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"
#include "lib/flux.glsl"

struct Operands {
  uvec2 a, b;
  uint divisor;
  float units;
  vec3 flux;
};
struct Results {
  uvec2 sum, quotient;
  uint rest;
  uvec2 fromFloat;
  float toFloat;
  vec3 unpacked;
};

layout(binding = 0, scalar) readonly buffer In { Operands items[]; };
layout(binding = 1, scalar) writeonly buffer Out { Results results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() {
  const uint i = invocationIndex();
  if (i >= count) return;
  const Operands o = items[i];
  Results r;
  r.sum = addFixed(o.a, o.b);
  r.quotient = divideFixed(o.a, o.divisor, r.rest);
  r.fromFloat = fixedFromFloat(o.units);
  r.toFloat = floatFromFixed(o.a);
  r.unpacked = unpackFlux(packFlux(o.flux));
  results[i] = r;
}
