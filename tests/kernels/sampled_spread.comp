// The steps to the neighbours of a sampled direction, beside its density.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bindings/scene.glsl"
#include "lib/sampled_spread.glsl"

struct Item {
  vec3 wo;
  float uLobe;
  vec2 u;
  float samples;
};
struct Result {
  vec3 stepU, stepV;
  vec3 wi;
  float pdf;
};

layout(scalar) readonly buffer In { Item items[]; };
layout(scalar) writeonly buffer Out { Result results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() {
  const uint i = invocationIndex();
  if (i >= count) return;
  const Item item = items[i];
  // The first triangle, seen from in front: the material is what counts.
  const Surface s = loadSurface(0u, vec2(0.3), vec3(0.0, -1.0, 0.0));
  const Bsdf b = makeBsdf(s, item.wo.z);
  const BsdfSample sampled = sampleBsdf(b, item.wo, item.uLobe, item.u);
  Spread u = Spread(vec3(0.0), vec3(0.0), 0.0), v = u;
  if (sampled.pdf > 0.0) sampledSpreads(b, item.wo, item.uLobe, item.u, sampled, item.samples, u, v);
  results[i] = Result(u.direction, v.direction, sampled.wi, sampled.pdf);
}
