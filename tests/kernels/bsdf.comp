// The BSDF of a surface without textures: a sampled direction, and the value for another one.
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
#include "lib/bsdf.glsl"

struct Query {
  vec3 baseColor;
  float metallic;
  float alpha;
  float transmission;
  float ior;
  float specular;
  uint isFront;
  uint isSolid;
  vec3 wo;
  vec3 wi;
  vec2 u;
  float uLobe;
  float coat;
  float coatAlpha;
  vec3 coatNormal;
  uint isAdjoint;
  vec3 specularColor;
  vec3 diffuseTransmissionColor;
  float diffuseTransmission;
  vec3 sheenColor;
  float sheenAlpha;
  vec2 stretch;  // of alpha along the tangent, 0 to 1; the tangent's angle
  float iridescence;
  float filmIor;
  float filmThickness;
  vec3 sheetDepth;
};
struct Answer {
  vec3 value;  // BSDF · |cosine| of (wo, wi)
  float pdf;   // of sampling wi, 1/sr
  vec3 sampled;
  vec3 weight;
  float sampledPdf;
  uint isDelta;
  uint isTransmission;
};

layout(binding = 0, scalar) readonly buffer In { Query items[]; };
layout(binding = 1, scalar) writeonly buffer Out { Answer results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

Surface surfaceOf(Query q) {
  Surface s;
  s.baseColor = q.baseColor;
  s.metallic = q.metallic;
  s.alpha = q.alpha;
  s.transmission = q.transmission;
  s.ior = q.ior;
  s.isFront = q.isFront != 0u;
  s.flags = q.isSolid != 0u ? kMaterialSolid : 0u;
  s.specularColor = q.specularColor;
  s.specular = q.specular;
  s.shadingNormal = vec3(0.0, 0.0, 1.0);
  s.coat = q.coat;
  s.coatAlpha = q.coatAlpha;
  s.coatNormal = q.coatNormal;
  s.coatCosOut = dot(q.wo, q.coatNormal);
  s.frame = mat3(1.0);
  s.backwards = q.wo;
  s.diffuseTransmissionColor = q.diffuseTransmissionColor;
  s.diffuseTransmission = q.diffuseTransmission;
  s.sheenColor = q.sheenColor;
  s.sheenAlpha = q.sheenAlpha;
  s.alphas = vec2(mix(q.alpha, 1.0, q.stretch.x), q.alpha);
  s.tangent = vec3(portableCosSin(q.stretch.y), 0.0);
  s.iridescence = q.iridescence;
  s.filmIor = q.filmIor;
  s.filmThickness = q.filmThickness;
  s.sheetDepth = q.sheetDepth;
  return s;
}

void main() {
  const uint i = invocationIndex();
  if (i >= count) return;
  const Query q = items[i];
  Bsdf b = makeBsdf(surfaceOf(q), q.wo.z);
  if (q.isAdjoint != 0u) makeAdjoint(b);
  Answer a;
  a.value = evalBsdf(b, q.wo, q.wi, a.pdf);
  const BsdfSample s = sampleBsdf(b, q.wo, q.uLobe, q.u);
  a.sampled = s.wi;
  a.weight = s.weight;
  a.sampledPdf = s.pdf;
  a.isDelta = uint(s.isDelta);
  a.isTransmission = uint(s.isTransmission);
  results[i] = a;
}
