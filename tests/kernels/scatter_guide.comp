// A direction drawn by a mixture of BSDF and guide, at a metallic surface over a diffuse base.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/scene_data.h"
#include "lib/dispatch.glsl"

uvec4 vertexTexel(uint i) { return uvec4(i); }
uvec4 triangleTexel(uint i) { return uvec4(i); }
uvec4 instanceTexel(uint i) { return uvec4(i); }
uint instanceOfPage(uint i) { return i; }
uvec4 materialTexel(uint i) { return uvec4(i); }
uvec4 textureTexel(uint i) { return uvec4(i); }
uint imageTexel(uint i) { return i; }
layout(binding = 2) uniform usamplerBuffer albedoWords;
uint albedoTexel(uint i) { return texelFetch(albedoWords, int(i)).x; }
layout(binding = 3, scalar) readonly buffer GuideBlock { float guide[]; };
float scatterGuide(uint i) { return guide[i]; }
#include "lib/scatter_guide.glsl"

struct Query {
  float share;
  float uLobe;
  vec2 u;
};
struct Answer {
  vec3 wi;
  float weight;
};

layout(binding = 0, scalar) readonly buffer In { Query items[]; };
layout(binding = 1, scalar) writeonly buffer Out { Answer results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() {
  const uint i = invocationIndex();
  if (i >= count) return;
  Surface s;
  s.baseColor = vec3(0.8);
  s.metallic = 0.3;
  s.alpha = 0.25;
  s.transmission = 0.0;
  s.ior = 1.5;
  s.isFront = true;
  s.flags = 0u;
  s.specularColor = vec3(1.0);
  s.specular = 1.0;
  s.shadingNormal = s.coatNormal = vec3(0.0, 0.0, 1.0);
  s.coat = 0.0;
  s.coatAlpha = 0.0;
  const vec3 wo = normalize(vec3(0.5, 0.2, 0.8));
  s.coatCosOut = wo.z;
  s.frame = mat3(1.0);
  s.backwards = wo;
  s.diffuseTransmission = 0.0;
  s.sheenColor = vec3(0.0);
  s.alphas = vec2(s.alpha);
  s.iridescence = 0.0;
  const Bsdf b = makeBsdf(s, wo.z);
  float scale;
  const BsdfSample sampled =
      sampleGuidedBsdf(b, wo, GuidedScatter(0u, items[i].share), items[i].uLobe, items[i].u, scale);
  results[i] = Answer(sampled.wi, sampled.weight.x * scale);
}
