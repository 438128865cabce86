// The importance map of the map at work, and required density from it.
#ifndef IMPORTON_BINDINGS_IMPORTANCE_GLSL
#define IMPORTON_BINDINGS_IMPORTANCE_GLSL
#include "bindings/parameters.glsl"

uniform usamplerBuffer importonCellsPairs;
uniform usamplerBuffer importonPointsTexels;
uniform samplerBuffer importancesWords;
uniform samplerBuffer importanceBoundsWords;
uniform usamplerBuffer importonHitsWords;

uvec2 importonCell(uint slot) { return texelFetch(importonCellsPairs, int(slot)).xy; }
uvec4 importonPoint(uint i) { return texelFetch(importonPointsTexels, int(i)); }
float importonImportance(uint i) { return texelFetch(importancesWords, int(i)).x; }

#include "lib/density.glsl"
#include "lib/importance.glsl"

GridFrame importonFrame() {
  return GridFrame(params.gridOrigin, params.gridExtent, slotMaskOf(textureSize(importonCellsPairs)));
}

/// Γ in pixels/m² at a point; 0 where no importon is near.
float importanceAt(MapSettings map, vec3 position, vec3 normal) {
  const uint importon = importonAt(importonFrame(), map.importonLevels, position, normal);
  return importon == kNone ? 0.0 : importonImportance(importon);
}

/// D_r in photons/m² at an importon [METHOD: D_r = M_r Γ], at least the floor, growing over passes; or the constant.
/// Γ is of the importance map, or by path differentials.
float requiredDensityAt(MapSettings map, uint importon) {
  const float importance = importon == kNone ? 0.0 : texelFetch(importanceBoundsWords, int(importon)).x;
  float density = max(map.photonsPerPixel * importance, map.densityFloor);
  if (map.constantDensity > 0.0) density = map.constantDensity;
  return min(density * params.densityScale, map.densityLimit);
}

float requiredDensity(MapSettings map, vec3 position, vec3 normal) {
  return requiredDensityAt(map, importonAt(importonFrame(), map.importonLevels, position, normal));
}

/// The density that a lookup counts on: the required one, or where the passes so far brought less, what they brought,
/// scaled so that fewer photons do. An importon stands for its share of the surface, 1/(importons per m²). Half a
/// hit is added to its count, for a place that has had none yet.
float lookupDensity(MapSettings map, vec3 position, vec3 normal) {
  if (map.constantDensity > 0.0) return requiredDensityAt(map, kNone);
  const uint importon = importonAt(importonFrame(), map.importonLevels, position, normal);
  const float required = requiredDensityAt(map, importon);
  if (map.photonsCounted == 0.0 || importon == kNone) return required;
  const float perArea = importonImportance(importon) / (map.importonFlux * float(kImportonsPerSite));
  const float hits = (float(texelFetch(importonHitsWords, int(importon)).x) + 0.5) / map.photonsCounted;
  const float available = hits * perArea * (map.lookupPhotons / map.fewestPhotons) * params.densityScale;
  return clamp(available, min(map.densityFloor * params.densityScale, required), required);
}

/// Radius of the lookup that holds M photons where the map has its required density, m.
float lookupRadius(MapSettings map, float density) {
  return radiusHolding(map.lookupPhotons, density, params.gridExtent);
}

/// Radius of the quota: holds Q photons, m.
float quotaRadius(float required) {
  return min(radiusHolding(params.quotaPhotons, required, params.gridExtent), params.largestQuotaRadius);
}

/// Photons within the quota radius at the required density: Q, or fewer where the radius is bounded; at least 1.
float quotaAt(float required, float radius) {
  return clamp(required * kPi * radius * radius, 1.0, params.quotaPhotons);
}

#endif
