// Cells of known area on the surfaces: src/render/surface_cache/surface_cells.h. A triangle cut into n parts along each
// side has n² equal cells, row by row; each row has upright cells and inverted ones between them.
#ifndef IMPORTON_LIB_SURFACE_CELL_GLSL
#define IMPORTON_LIB_SURFACE_CELL_GLSL

/// Number, among the n² cells of a triangle, of the one at barycentric weights `uv`.
uint cellInTriangle(vec2 uv, uint n) {
  const vec2 scaled = clamp(uv, vec2(0.0), vec2(1.0)) * float(n);
  const uint row = min(uint(scaled.y), n - 1u);
  const uint column = min(uint(scaled.x), n - 1u - row);
  const vec2 rest = scaled - vec2(column, row);
  const uint isInverted = uint(rest.x + rest.y > 1.0 && column + row + 1u < n);
  return row * (2u * n - row) + 2u * column + isInverted;
}

#endif
