// Warps of the unit square by number, the weight of two densities, and the frame around a direction.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"
#include "lib/sampling.glsl"

struct Sample {
  uint warp;
  float cosMax;
  vec2 u;
  vec3 axis;
};
struct Warped {
  vec3 point;
  mat3 frame;
};

layout(binding = 0, scalar) readonly buffer In { Sample items[]; };
layout(binding = 1, scalar) writeonly buffer Out { Warped results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

vec3 warp(Sample s) {
  if (s.warp == 0u) return vec3(sampleDisc(s.u), 0.0);
  if (s.warp == 1u) return sampleCosineHemisphere(s.u);
  if (s.warp == 2u) return sampleSphere(s.u);
  if (s.warp == 3u) return sampleCone(s.u, s.cosMax);
  if (s.warp == 5u) return vec3(powerHeuristic(s.u.x, s.u.y), 0.0, 0.0);
  return vec3(sampleTriangle(s.u), 0.0);
}

void main() {
  const uint i = invocationIndex();
  if (i < count) results[i] = Warped(warp(items[i]), frameAround(items[i].axis));
}
