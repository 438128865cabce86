// Share of light that rough interfaces scatter in a single event: what they miss is scattered more than once.
// The kernel defines `uint albedoTexel(uint index)` (shared/albedo_table.h) before including this file.
#ifndef IMPORTON_LIB_ALBEDO_GLSL
#define IMPORTON_LIB_ALBEDO_GLSL
#include "shared/albedo_table.h"

const float kSmoothAlpha = 1e-3;  // below: reflection and transmission are deltas

/// Mean of Schlick's reflectance over the cosine.
vec3 meanSchlick(vec3 f0, float f90) { return f0 + (vec3(f90) - f0) * (1.0 / 21.0); }

/// Share of multiply scattered light that comes back: a series of reflections of which each lets `meanAlbedo` out.
/// [Kulla and Conty 2017]
vec3 multipleReflectance(vec3 meanFresnel, float meanAlbedo) {
  return meanFresnel * meanFresnel * meanAlbedo / max(vec3(1.0) - meanFresnel * (1.0 - meanAlbedo), vec3(1e-6));
}

/// Share of light that a GGX layer of Schlick's reflectance turns back along a direction.
float layerReflectance(float f0, float f90, float missed, vec2 albedo) {
  return f0 * (albedo.x - albedo.y) + f90 * albedo.y + missed * (1.0 - albedo.x);
}

vec2 albedoAt(uint index) { return unpackUnorm2x16(albedoTexel(index)); }

/// Between four entries: from `at`, x along its row, y towards the next row, `count` entries on.
vec2 albedoBetween(uint at, uint count, float x, float y) {
  return mix(mix(albedoAt(at), albedoAt(at + 1u), x), mix(albedoAt(at + count), albedoAt(at + count + 1u), x), y);
}

/// Place in a row of `count` entries over the square root of `value` in 0 .. 1: the lower entry and the share of
/// the next one.
float tablePlace(float value, uint count, out uint index) {
  const float x = sqrt(clamp(value, 0.0, 1.0)) * float(count - 1u);
  index = min(uint(x), count - 2u);
  return x - float(index);
}

/// x: share of light that GGX reflects at once with Fresnel 1; y: the same weighted with (1 - cosine)^5, as Schlick's
/// reflectance f0 + (f90 - f0) (1 - cosine)^5 asks for.
vec2 ggxAlbedo(float cosine, float alpha) {
  uint i, j;
  const float x = tablePlace(cosine, kAlbedoSide, i), y = tablePlace(alpha, kAlbedoSide, j);
  const uint at = j * kAlbedoSide + i;
  return albedoBetween(at, kAlbedoSide, x, y);
}

/// The same for light from everywhere.
vec2 ggxMeanAlbedo(float alpha) {
  uint j;
  const float y = tablePlace(alpha, kAlbedoSide, j);
  return mix(albedoAt(kAlbedoMeans + j), albedoAt(kAlbedoMeans + j + 1u), y);
}

/// Entry of the relative index `eta`, as tablePlace.
float glassPlace(float eta, out uint index) {
  const float n = max(eta, 1.0 / eta);
  const float x = min((n - 1.0) / (n + 1.0) * (float(kGlassAlbedoIndices - 1u) / kGlassAlbedoLargest),
                      float(kGlassAlbedoIndices - 1u));
  index = min(uint(x), kGlassAlbedoIndices - 2u);
  return x - float(index);
}

/// Share of light that a rough dielectric reflects and transmits at once, from the side whose other side has the
/// index `eta` over its own.
float glassAlbedo(float cosine, float alpha, float eta) {
  uint i, j, k;
  const float x = tablePlace(cosine, kGlassAlbedoSide, i), y = tablePlace(alpha, kGlassAlbedoSide, j);
  const float z = glassPlace(eta, k);
  vec2 rows[2];
  for (uint l = 0u; l < 2u; ++l) {
    const uint at = kGlassAlbedo + ((k + l) * kGlassAlbedoSide + j) * kGlassAlbedoSide + i;
    rows[l] = albedoBetween(at, kGlassAlbedoSide, x, y);
  }
  const vec2 sides = mix(rows[0], rows[1], z);
  return eta >= 1.0 ? sides.x : sides.y;
}

/// The same for light from everywhere; y: from the other side.
vec2 glassMeanAlbedo(float alpha, float eta) {
  uint j, k;
  const float y = tablePlace(alpha, kGlassAlbedoSide, j), z = glassPlace(eta, k);
  const uint at = kGlassAlbedoMeans + k * kGlassAlbedoSide + j;
  const vec2 sides = albedoBetween(at, kGlassAlbedoSide, y, z);
  return eta >= 1.0 ? sides : sides.yx;
}

/// What a coat that turns light back on the way in or out, whichever is more, takes from light along `cosine` beyond
/// the way out. x: over a white metal of roughness `alpha`; y: over a white diffuse surface.
vec2 coatTaken(float cosine, float alpha, float coatAlpha) {
  uint i, j, k;
  const float x = tablePlace(cosine, kCoatSide, i), y = tablePlace(alpha, kCoatSide, j);
  const float z = tablePlace(coatAlpha, kCoatAlphas, k);
  const uint at = kCoatTaken + (k * kCoatSide + j) * kCoatSide + i, above = at + kCoatSide * kCoatSide;
  const vec2 low = albedoBetween(at, kCoatSide, x, y);
  const vec2 high = albedoBetween(above, kCoatSide, x, y);
  return mix(low, high, z);
}

/// The same for light from everywhere.
vec2 coatMeanTaken(float alpha, float coatAlpha) {
  uint j, k;
  const float y = tablePlace(alpha, kCoatSide, j), z = tablePlace(coatAlpha, kCoatAlphas, k);
  const uint at = kCoatMeans + k * kCoatSide + j;
  return albedoBetween(at, kCoatSide, y, z);
}

/// x: share of light along `cosine` that white sheen reflects; y: the bound on its value there.
vec2 sheenAlbedo(float cosine, float alpha) {
  uint i, j;
  const float x = tablePlace(cosine, kSheenSide, i), y = tablePlace(alpha, kSheenSide, j);
  const uint at = kSheenAlbedo + j * kSheenSide + i;
  return albedoBetween(at, kSheenSide, x, y);
}

/// Entries of GGX of roughness alphas.x along the tangent and alphas.y across it, which is not more: of the roughness
/// across and of the stretch along.
vec2 stretchPlace(vec2 alphas, out uvec2 index) {
  const float x = tablePlace(alphas.y, kStretchAlphas, index.x);
  return vec2(x, tablePlace((alphas.x - alphas.y) / max(1.0 - alphas.y, 1e-6), kStretches, index.y));
}

/// As ggxAlbedo. `azimuth`: squared cosine of the angle between the direction's projection and the tangent.
vec2 stretchedAlbedo(float cosine, float azimuth, vec2 alphas) {
  uvec2 at;
  const vec2 share = stretchPlace(alphas, at);
  const float rough = sqrt(mix(alphas.y * alphas.y, alphas.x * alphas.x, azimuth));
  uint i, k;
  const float x = tablePlace(cosine, kStretchCosines, i);
  const float z = tablePlace((rough - alphas.y) / max(alphas.x - alphas.y, 1e-6), kStretchAzimuths, k);
  vec2 sum = vec2(0.0);
  for (uint corner = 0u; corner < 8u; ++corner) {
    const uint b = corner & 1u, s = (corner >> 1) & 1u, t = corner >> 2;
    const float weight = (b == 1u ? share.x : 1.0 - share.x) * (s == 1u ? share.y : 1.0 - share.y) *
                         (t == 1u ? z : 1.0 - z);
    const uint row = ((at.x + b) * kStretches + at.y + s) * kStretchAzimuths + k + t;
    const uint texel = kStretchAlbedo + row * kStretchCosines + i;
    sum += weight * mix(albedoAt(texel), albedoAt(texel + 1u), x);
  }
  return sum;
}

vec2 stretchedMeanAlbedo(vec2 alphas) {
  uvec2 at;
  const vec2 share = stretchPlace(alphas, at);
  const uint texel = kStretchMeans + at.x * kStretches + at.y;
  return albedoBetween(texel, kStretches, share.y, share.x);
}

#endif
