// Samples of an environment map, and its radiance and density in a direction.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"

struct Query {
  vec2 u;
  vec3 direction;
};
struct Answer {
  vec3 sampled;
  float sampledPdf;
  vec3 radiance;
  float pdf;
};

layout(binding = 0, scalar) readonly buffer In { Query items[]; };
layout(binding = 1, scalar) writeonly buffer Out { Answer results[]; };
layout(binding = 2) uniform usamplerBuffer environmentTexels;
layout(binding = 3) uniform usamplerBuffer drawPairs;
layout(push_constant, scalar) uniform Push {
  uint count;
  uvec2 size;
};

uvec4 environmentTexel(uint i) { return texelFetch(environmentTexels, int(i)); }
uvec2 environmentDrawn(uint i) { return texelFetch(drawPairs, int(i)).xy; }
uvec2 environmentSize() { return size; }
#include "lib/environment.glsl"

void main() {
  const uint i = invocationIndex();
  if (i >= count) return;
  Answer a;
  a.sampled = sampleEnvironment(items[i].u, a.sampledPdf);
  a.radiance = environmentRadiance(items[i].direction);
  a.pdf = pdfEnvironment(items[i].direction);
  results[i] = a;
}
