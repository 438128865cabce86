// A hashed grid of many cell sizes. A point of radius r lives in one cell of level l, whose edge is at least 2r
// and less than 4r; a search of radius r visits the levels next to its own as well, so it finds every point
// whose radius is within a factor of two of its own. Points of a slot that belong to another cell (hash
// collision) are told apart by recomputing their cell: none is counted twice.
// The kernel defines `uvec2 gridCell(uint slot)` (first point, end) before including this file.
#ifndef IMPORTON_LIB_GRID_GLSL
#define IMPORTON_LIB_GRID_GLSL
#include "lib/hash.glsl"

const uint kGridLevels = 21u;  // levels 0 .. 20: the smallest cell is 2^-20 of the scene

/// Frame of a grid: lowest corner, extent (a power of two, in m) and slots (a power of two).
struct GridFrame {
  vec3 origin;
  float extent;
  uint slotMask;
};

/// Level of a point of radius r: the finest with cells of at least 2r.
uint gridLevel(GridFrame frame, float radius) {
  const float cells = frame.extent / (2.0 * radius);
  if (!(cells >= 1.0)) return 0u;
  return min((floatBitsToUint(cells) >> 23) - 127u, kGridLevels - 1u);  // floor(log2(cells))
}

/// Edge of the cells of a level, m.
float gridCellEdge(GridFrame frame, uint level) { return ldexp(frame.extent, -int(level)); }

ivec3 gridCellOf(GridFrame frame, vec3 position, uint level) {
  return ivec3(floor((position - frame.origin) * (float(1u << level) / frame.extent)));
}

uint gridSlot(GridFrame frame, ivec3 cell, uint level) {
  const uint x = uint(cell.x) * 0x8DA6B343u ^ uint(cell.y) * 0xD8163841u ^ uint(cell.z) * 0xCB1AB31Fu;
  return hash(x + level * 0x9E3779B9u) & frame.slotMask;
}

#endif
