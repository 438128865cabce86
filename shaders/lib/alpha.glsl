// Alpha coverage: whether a surface is there at all where a ray meets it.
// The kernel defines the accessors that lib/surface.glsl asks for before including this file.
#ifndef IMPORTON_LIB_ALPHA_GLSL
#define IMPORTON_LIB_ALPHA_GLSL
#include "lib/hash.glsl"
#include "lib/surface.glsl"

/// glTF alphaMode MASK compares with the cutoff; BLEND is there with probability alpha, decided anew for each triangle and
/// rayId. OPAQUE is always there. `uv`: barycentric weights of the second and third vertex.
bool isCovered(uint triangle, vec2 uv, uint rayId) {
  const uvec4 indices = triangleTexel(triangle);
  const uint base = 8u * indices.w;
  const uvec4 m5 = materialTexel(base + 5u);
  const uint flags = m5.z;
  if ((flags & (kMaterialAlphaMask | kMaterialAlphaBlend)) == 0u) return true;
  const vec3 weights = vec3(1.0 - uv.x - uv.y, uv);
  float alpha = uintBitsToFloat(materialTexel(base).w);
  if (kHasVertexColors) {
    vec4 tangent, color;
    interpolateExtras(indices.xyz, weights, tangent, color);
    alpha *= color.a;
  }
  if (kHasTextures) {
    vec2 uv0, uv1;
    interpolateUv(indices.xyz, weights, uv0, uv1);
    alpha *= texturedOr1(m5.w, uv0, uv1).a;
  }
  if ((flags & kMaterialAlphaMask) != 0u) return alpha >= uintBitsToFloat(materialTexel(base + 4u).w);
  return unitFloat(hashCombine(rayId, triangle)) < alpha;
}

#endif
