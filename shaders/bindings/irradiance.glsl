// The irradiance map: for both sides of each surface cell the flux that came in so far, and the cell's area.
#ifndef IMPORTON_BINDINGS_IRRADIANCE_GLSL
#define IMPORTON_BINDINGS_IRRADIANCE_GLSL
#include "bindings/parameters.glsl"
#include "lib/flux.glsl"
#include "lib/surface_cell.glsl"

layout(constant_id = kSpecReadsCells) const bool kReadsCells = false;
layout(binding = kBindingSurfaceCells) uniform usamplerBuffer surfaceCells;
layout(binding = kBindingIrradianceTexels) uniform usamplerBuffer irradianceTexels;

/// Number of the side of a cell that faces a ray at a hit: two for each cell.
uint cellSide(uint triangle, vec2 uv, bool isFront) {
  const uvec2 cells = texelFetch(surfaceCells, int(triangle)).xy;
  return 2u * (cells.x + cellInTriangle(uv, cells.y)) + uint(isFront);
}

/// Irradiance, W/m², of the passes so far; and the cell's area, m².
vec3 cellIrradiance(uint side, out float area) {
  const uvec4 a = texelFetch(irradianceTexels, int(2u * side)), b = texelFetch(irradianceTexels, int(2u * side + 1u));
  area = uintBitsToFloat(b.w);
  const vec3 flux = vec3(floatFromFixed(a.xy), floatFromFixed(a.zw), floatFromFixed(b.xy));
  return flux * (params.irradianceScale / max(area, 1e-30));
}

/// Photons that came in so far.
uint cellPhotons(uint side) { return texelFetch(irradianceTexels, int(2u * side + 1u)).z; }

#endif
