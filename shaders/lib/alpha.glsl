// Alpha coverage. Include after bindings/scene.glsl or what defines its accessors.
#ifndef IMPORTON_LIB_ALPHA_GLSL
#define IMPORTON_LIB_ALPHA_GLSL
#include "lib/hash.glsl"
#include "lib/surface.glsl"

/// True if a ray meets the surface at this point of the triangle: alpha at least the cut-off of a masked
/// material; a blended one stops rays with the probability of its alpha, decided by the ray and the triangle.
bool isCovered(uint triangle, vec2 uvWeights, uint rayId) {
  const uvec4 indices = triangleTexel(triangle);
  const uint base = kMaterialTexels * indices.w;
  const uvec4 m5 = materialTexel(base + 5u);
  if ((m5.z & (kMaterialAlphaMask | kMaterialAlphaBlend)) == 0u) return true;
  float alpha = uintBitsToFloat(materialTexel(base).w);
  const vec3 weights = vec3(1.0 - uvWeights.x - uvWeights.y, uvWeights);
  if (kHasVertexColors) {
    vec4 tangent, color;
    interpolateExtras(indices.xyz, weights, tangent, color);
    alpha *= color.a;
  }
  if (kHasTextures && m5.w != kNone) {
    vec2 uv0, uv1;
    interpolateUv(indices.xyz, weights, uv0, uv1);
    alpha *= sampleTexture(m5.w, uv0, uv1).a;
  }
  if ((m5.z & kMaterialAlphaMask) != 0u) return alpha >= uintBitsToFloat(materialTexel(base + 4u).w);
  return unitFloat(hashCombine(rayId, triangle)) < alpha;
}

#endif
