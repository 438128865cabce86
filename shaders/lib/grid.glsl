// A hashed grid of many cell sizes. A point of radius r lives in one cell of level l, whose edge is at least 4/3 r
// and less than 8/3 r; a search of radius r visits the levels next to its own as well, so it finds every point
// whose radius is within a factor of two of its own. No search spans more than four cells along an axis, and cells
// within four of each other never share a slot, so a search sees no slot twice on one level; points of other levels
// are told by the level they carry. So nothing is counted twice, whatever collides.
#ifndef IMPORTON_LIB_GRID_GLSL
#define IMPORTON_LIB_GRID_GLSL
#include "lib/hash.glsl"
#include "shared/elementary.h"

const uint kGridLevels = 21u;  // levels 0 .. 20: the smallest cell is 2^-20 of the scene

/// Frame of a grid: lowest corner, extent (a power of two, in m) and slots (a power of two).
struct GridFrame {
  vec3 origin;
  float extent;
  uint slotMask;
};

/// Mask of a power of two slots, from the length of their texel buffer, which has some padding.
uint slotMaskOf(int length) { return (1u << findMSB(length)) - 1u; }

/// Level of a point of radius r: the finest with cells of at least 4/3 r.
uint gridLevel(GridFrame frame, float radius) {
  const float cells = frame.extent / (1.3333334 * radius);
  if (!(cells >= 1.0)) return 0u;
  return min((floatBitsToUint(cells) >> 23) - 127u, kGridLevels - 1u);  // floor(log2(cells))
}

/// Edge of the cells of a level, m.
float gridCellEdge(GridFrame frame, uint level) { return frame.extent * powerOfTwo(-int(level)); }

ivec3 gridCellOf(GridFrame frame, vec3 position, uint level) {
  return ivec3(floor((position - frame.origin) * (float(1u << level) / frame.extent)));
}

/// Blocks of 4x4x4 cells are hashed; inside a block every cell has its own slot.
uint gridSlot(GridFrame frame, ivec3 cell, uint level) {
  const uvec3 block = uvec3(cell >> 2);
  const uvec3 inner = uvec3(cell & 3);
  const uint mixed = block.x * 0x8DA6B343u ^ block.y * 0xD8163841u ^ block.z * 0xCB1AB31Fu;
  return (hash(mixed + level * 0x9E3779B9u) << 6 | inner.x | inner.y << 2 | inner.z << 4) & frame.slotMask;
}

#endif
