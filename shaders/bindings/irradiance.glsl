// The irradiance map, as gather rays read it: for both sides of each surface cell the irradiance, and the cell's area.
#ifndef IMPORTON_BINDINGS_IRRADIANCE_GLSL
#define IMPORTON_BINDINGS_IRRADIANCE_GLSL
#include "bindings/parameters.glsl"
#include "lib/features.glsl"
#include "lib/surface_cell.glsl"

layout(constant_id = kSpecReadsCells) const bool kReadsCells = false;
uniform usamplerBuffer surfaceCellsPairs;
uniform usamplerBuffer placedCellsPairs;
uniform usamplerBuffer cellIrradiancesTexels;

/// First cell of a triangle, and into how many parts its sides are cut: src/render/surface_cache/surface_cells.h.
uvec2 cellsOfTriangle(uint number) {
  if (!kHasInstances || (number & kPlacedTriangle) == 0u) return texelFetch(surfaceCellsPairs, int(number)).xy;
  const uvec2 page = texelFetch(placedCellsPairs, int((number & ~kPlacedTriangle) >> kPageBits)).xy;
  const uvec2 cells = texelFetch(placedCellsPairs, int(page.y + (number & (kPageTriangles - 1u)))).xy;
  return uvec2(page.x + cells.x, cells.y);
}

/// Number of the side of a cell that faces a ray at a hit: two for each cell.
uint cellSide(uint triangle, vec2 uv, bool isFront) {
  const uvec2 cells = cellsOfTriangle(triangle);
  return 2u * (cells.x + cellInTriangle(uv, cells.y)) + uint(isFront);
}

/// Irradiance, W/m², of the passes so far; and the cell's area, m².
vec3 cellIrradiance(uint side, out float area) {
  const uvec4 cell = texelFetch(cellIrradiancesTexels, int(side));
  area = uintBitsToFloat(cell.w);
  return uintBitsToFloat(cell.xyz) * params.irradianceScale;
}

#endif
