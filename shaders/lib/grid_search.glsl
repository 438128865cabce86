// Walks over the points within a box around a centre, one at a time, so that the lanes of a SIMD unit stay busy:
//   GridSearch search = beginSearch(frame, centre, radius);
//   while (nextPoint(search)) { ... search.index, search.point ... }
// The kernel defines `uvec2 gridCell(uint slot)` and `uvec4 gridPoint(uint index)` before including this file.
#ifndef IMPORTON_LIB_GRID_SEARCH_GLSL
#define IMPORTON_LIB_GRID_SEARCH_GLSL
#include "lib/grid.glsl"
#include "lib/map_point.glsl"

struct GridSearch {
  GridFrame frame;
  vec3 centre;
  float radius;
  uint level;       // at work
  uint lastLevel;
  ivec3 cell;       // at work
  ivec3 cellMin;
  ivec3 cellMax;
  uint index;       // of the point at hand, in cell order
  uint end;         // of the slot at work
  vec3 position;    // of the point at hand
  uint packed;
  bool isBegun;
};

void beginLevel(inout GridSearch search) {
  search.cellMin = gridCellOf(search.frame, search.centre - search.radius, search.level);
  search.cellMax = gridCellOf(search.frame, search.centre + search.radius, search.level);
  search.cell = search.cellMin;
}

/// Searches the levels `firstLevel` .. `lastLevel`.
GridSearch beginSearchLevels(GridFrame frame, vec3 centre, float radius, uint firstLevel, uint lastLevel) {
  GridSearch search;
  search.frame = frame;
  search.centre = centre;
  search.radius = radius;
  search.level = firstLevel;
  search.lastLevel = lastLevel;
  search.index = 0u;
  search.end = 0u;
  search.isBegun = false;
  beginLevel(search);
  return search;
}

/// Searches for points whose own radius is within a factor of two of `ownRadius`, which sets the levels.
GridSearch beginSearch(GridFrame frame, vec3 centre, float radius, float ownRadius) {
  const uint level = gridLevel(frame, ownRadius);
  return beginSearchLevels(frame, centre, radius, level > 0u ? level - 1u : 0u, min(level + 1u, kGridLevels - 1u));
}

/// Steps to the next cell; false when all are done.
bool nextCell(inout GridSearch search) {
  if (!search.isBegun) {
    search.isBegun = true;
  } else if (++search.cell.x > search.cellMax.x) {
    search.cell.x = search.cellMin.x;
    if (++search.cell.y > search.cellMax.y) {
      search.cell.y = search.cellMin.y;
      if (++search.cell.z > search.cellMax.z) {
        if (++search.level > search.lastLevel) return false;
        beginLevel(search);
      }
    }
  }
  const uvec2 range = gridCell(gridSlot(search.frame, search.cell, search.level));
  search.index = range.x;
  search.end = range.y;
  return true;
}

/// Steps to the next point of a visited cell (not yet tested for distance); false when all are done.
bool nextPoint(inout GridSearch search) {
  if (search.isBegun) ++search.index;
  for (;;) {
    while (search.index >= search.end)
      if (!nextCell(search)) return false;
    const uvec4 point = gridPoint(search.index);
    search.position = uintBitsToFloat(point.xyz);
    search.packed = point.w;
    if (mapPointLevel(point.w) == search.level &&
        gridCellOf(search.frame, search.position, search.level) == search.cell)
      return true;
    ++search.index;
  }
}

/// Leaves the cell at work.
void skipCell(inout GridSearch search) { search.index = search.end; }

#endif
