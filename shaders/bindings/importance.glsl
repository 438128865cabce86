// The importance map of the map at work, and required density from it.
#ifndef IMPORTON_BINDINGS_IMPORTANCE_GLSL
#define IMPORTON_BINDINGS_IMPORTANCE_GLSL
#include "bindings/parameters.glsl"

layout(binding = kBindingImportonCells) uniform usamplerBuffer importonCells;
layout(binding = kBindingImportonPoints) uniform usamplerBuffer importonPoints;
layout(binding = kBindingImportance) uniform samplerBuffer importances;

uvec2 importonCell(uint slot) { return texelFetch(importonCells, int(slot)).xy; }
uvec4 importonPoint(uint i) { return texelFetch(importonPoints, int(i)); }
float importonImportance(uint i) { return texelFetch(importances, int(i)).x; }

#include "lib/density.glsl"
#include "lib/importance.glsl"

GridFrame importonFrame() {
  return GridFrame(params.gridOrigin, params.gridExtent, uint(textureSize(importonCells)) - 1u);
}

/// D_r in photons/m² [METHOD: D_r = M_r Γ], at least the floor, growing over passes; or the constant one.
float requiredDensity(MapSettings map, vec3 position, vec3 normal) {
  if (map.constantDensity > 0.0) return map.constantDensity * params.densityScale;
  const float importance = importanceAt(importonFrame(), map.importonLevels, position, normal);
  return max(map.photonsPerPixel * importance, map.densityFloor) * params.densityScale;
}

/// Radius of the lookup that holds M photons where the map has its required density, m.
float lookupRadius(float required) { return radiusHolding(params.lookupPhotons, required, params.gridExtent); }

/// Radius of the quota: half of it, so a quarter of the photons (Q), m.
float quotaRadius(float required) { return radiusHolding(params.quotaPhotons, required, params.gridExtent); }

#endif
