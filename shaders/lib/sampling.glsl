// Warps of the unit square, with their densities.
#ifndef IMPORTON_LIB_SAMPLING_GLSL
#define IMPORTON_LIB_SAMPLING_GLSL
#include "shared/elementary.h"

const float kPi = 3.14159265358979;

/// Area-preserving map to the unit disc. [Shirley and Chiu 1997]
vec2 sampleDisc(vec2 u) {
  const vec2 p = 2.0 * u - 1.0;
  if (p.x == 0.0 && p.y == 0.0) return vec2(0.0);
  const bool isWide = abs(p.x) > abs(p.y);
  const float r = isWide ? p.x : p.y;
  const float phi = isWide ? (kPi / 4.0) * (p.y / p.x) : kPi / 2.0 - (kPi / 4.0) * (p.x / p.y);
  return r * portableCosSin(phi);
}

/// Around +z, density cos/π per sr.
vec3 sampleCosineHemisphere(vec2 u) {
  const vec2 d = sampleDisc(u);
  return vec3(d, sqrt(max(0.0, 1.0 - dot(d, d))));
}

/// Uniform over the unit sphere, density 1/(4π) per sr.
vec3 sampleSphere(vec2 u) {
  const float z = 1.0 - 2.0 * u.x;
  const float r = sqrt(max(0.0, 1.0 - z * z));
  return vec3(r * portableCosSin(2.0 * kPi * u.y), z);
}

/// Uniform over the cone around +z with half-angle acos(cosMax), density 1/(2π(1-cosMax)) per sr.
vec3 sampleCone(vec2 u, float cosMax) {
  const float z = 1.0 - u.x * (1.0 - cosMax);
  const float r = sqrt(max(0.0, 1.0 - z * z));
  return vec3(r * portableCosSin(2.0 * kPi * u.y), z);
}

/// Barycentric weights (of v1 and v2) uniform over a triangle. [Heitz 2019, A Low-Distortion Map]
vec2 sampleTriangle(vec2 u) {
  return u.y > u.x ? vec2(u.x * 0.5, u.y - u.x * 0.5) : vec2(u.x - u.y * 0.5, u.y * 0.5);
}

/// Orthonormal basis whose third column is the unit vector n. [Duff et al. 2017]
mat3 frameAround(vec3 n) {
  const float s = n.z >= 0.0 ? 1.0 : -1.0;
  const float a = -1.0 / (s + n.z);
  const float b = n.x * n.y * a;
  return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

float maxComponent(vec3 v) { return max(v.x, max(v.y, v.z)); }
float mean(vec3 v) { return (v.x + v.y + v.z) * (1.0 / 3.0); }

/// Weight of one technique of density a against another of density b. [Veach 1997, power heuristic]
float powerHeuristic(float a, float b) {
  const float ratio = b / a;  // safe for a > 0, also where a² would overflow
  return 1.0 / (1.0 + ratio * ratio);
}

#endif
