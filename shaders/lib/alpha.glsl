// Alpha coverage. Include after bindings/scene.glsl or what defines its accessors.
#ifndef IMPORTON_LIB_ALPHA_GLSL
#define IMPORTON_LIB_ALPHA_GLSL
#include "lib/hash.glsl"
#include "lib/surface.glsl"

/// Share of a triangle's surface that is there at barycentric `weights`: of a masked material 1 where alpha is at
/// least the cut-off, else 0; of a blended one alpha; of others 1.
float coverageAt(uvec4 triangle, vec3 weights) {
  const uint base = kMaterialTexels * triangle.w;
  const uvec4 m5 = materialTexel(base + 5u);
  if ((m5.z & (kMaterialAlphaMask | kMaterialAlphaBlend)) == 0u) return 1.0;
  float alpha = uintBitsToFloat(materialTexel(base).w);
  if (kHasVertexColors) {
    vec4 tangent, color;
    interpolateExtras(noPlacement(), triangle.xyz, weights, tangent, color);
    alpha *= color.a;
  }
  if (kHasTextures && m5.w != kNone) {
    vec2 uv0, uv1;
    interpolateUv(triangle.xyz, weights, uv0, uv1);
    alpha *= sampleTexture(m5.w, uv0, uv1).a;
  }
  if ((m5.z & kMaterialAlphaMask) != 0u) return alpha >= uintBitsToFloat(materialTexel(base + 4u).w) ? 1.0 : 0.0;
  return clamp(alpha, 0.0, 1.0);
}

/// True if a ray meets the surface at this point of the triangle: a blended material stops rays with the probability
/// of its coverage, decided by the ray and the triangle. `stored`: its index in the scene; `number`: as hits have it.
bool isCovered(uint stored, uint number, vec2 uvWeights, uint rayId) {
  const float coverage = coverageAt(triangleTexel(stored), vec3(1.0 - uvWeights.x - uvWeights.y, uvWeights));
  return coverage >= 1.0 || unitFloat(hashCombine(rayId, number)) < coverage;
}

#endif
