// The GGX distribution of microfacets in the local frame (z: shading normal).
#ifndef IMPORTON_LIB_GGX_GLSL
#define IMPORTON_LIB_GGX_GLSL
#include "lib/sampling.glsl"
#include "shared/elementary.h"

/// Density of normals, 1/sr. [Walter et al. 2007, eq. 33]
float ggxDistribution(vec3 h, float alpha) {
  // Written without 1 - cos², which would lose all digits of a sharp peak.
  const float sin2 = h.x * h.x + h.y * h.y;
  const float a2 = alpha * alpha;
  const float d = sin2 + a2 * h.z * h.z;
  return a2 / (kPi * d * d);
}

/// Smith's Λ. [Heitz 2014, eq. 72]
float ggxLambda(vec3 w, float alpha) {
  const float cos2 = w.z * w.z;
  const float tan2 = (w.x * w.x + w.y * w.y) / max(cos2, 1e-30);
  return 0.5 * (sqrt(1.0 + alpha * alpha * tan2) - 1.0);
}

float ggxMasking(vec3 w, float alpha) { return 1.0 / (1.0 + ggxLambda(w, alpha)); }

/// Height-correlated masking and shadowing. [Heitz 2014, eq. 99]
float ggxMaskingShadowing(vec3 wo, vec3 wi, float alpha) {
  return 1.0 / (1.0 + ggxLambda(wo, alpha) + ggxLambda(wi, alpha));
}

/// A normal visible from wo (wo.z > 0); alphas along x and y. [Heitz 2018, listing 1]
vec3 sampleVisibleNormal(vec3 wo, vec2 alphas, vec2 u) {
  const vec3 v = normalize(vec3(alphas * wo.xy, wo.z));
  const float length2 = dot(v.xy, v.xy);
  const vec3 t1 = length2 > 0.0 ? vec3(-v.y, v.x, 0.0) * inversesqrt(length2) : vec3(1.0, 0.0, 0.0);
  const vec3 t2 = cross(v, t1);
  const float r = sqrt(u.x), phi = 2.0 * kPi * u.y;
  const vec2 turn = portableCosSin(phi);
  const float x = r * turn.x;
  const float s = 0.5 * (1.0 + v.z);
  const float y = (1.0 - s) * sqrt(max(0.0, 1.0 - x * x)) + s * r * turn.y;
  const vec3 n = x * t1 + y * t2 + sqrt(max(0.0, 1.0 - x * x - y * y)) * v;
  return normalize(vec3(alphas * n.xy, max(1e-9, n.z)));
}

vec3 sampleVisibleNormal(vec3 wo, float alpha, vec2 u) { return sampleVisibleNormal(wo, vec2(alpha), u); }

/// Density of sampleVisibleNormal, 1/sr of normals. [Heitz 2018, eq. 3]
float pdfVisibleNormal(vec3 wo, vec3 h, float alpha) {
  return ggxMasking(wo, alpha) * max(0.0, dot(wo, h)) * ggxDistribution(h, alpha) / max(wo.z, 1e-30);
}

// Anisotropic: alphas.x along x, alphas.y along y.

/// [Heitz 2014, eq. 85]
float ggxDistribution(vec3 h, vec2 alphas) {
  const vec2 slope = h.xy / alphas;
  const float d = dot(slope, slope) + h.z * h.z;
  return 1.0 / (kPi * alphas.x * alphas.y * d * d);
}

/// [Heitz 2014, eq. 86]
float ggxLambda(vec3 w, vec2 alphas) {
  const vec2 rough = alphas * w.xy;
  return 0.5 * (sqrt(1.0 + dot(rough, rough) / max(w.z * w.z, 1e-30)) - 1.0);
}

float ggxMasking(vec3 w, vec2 alphas) { return 1.0 / (1.0 + ggxLambda(w, alphas)); }

float ggxMaskingShadowing(vec3 wo, vec3 wi, vec2 alphas) {
  return 1.0 / (1.0 + ggxLambda(wo, alphas) + ggxLambda(wi, alphas));
}

float pdfVisibleNormal(vec3 wo, vec3 h, vec2 alphas) {
  return ggxMasking(wo, alphas) * max(0.0, dot(wo, h)) * ggxDistribution(h, alphas) / max(wo.z, 1e-30);
}

#endif
