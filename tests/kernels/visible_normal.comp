// A visible normal and the density of another one.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"
#include "lib/ggx.glsl"

struct Query {
  vec3 wo;
  float alpha;
  vec2 u;
  vec3 h;
};
struct Answer {
  vec3 sampled;
  float pdf;  // of h, 1/sr
};

layout(binding = 0, scalar) readonly buffer In { Query items[]; };
layout(binding = 1, scalar) writeonly buffer Out { Answer results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() {
  const uint i = invocationIndex();
  if (i >= count) return;
  const Query q = items[i];
  results[i] = Answer(sampleVisibleNormal(q.wo, q.alpha, q.u), pdfVisibleNormal(q.wo, q.h, q.alpha));
}
