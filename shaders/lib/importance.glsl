// The importon that speaks for a point: a near one with a like normal. The kernel defines
// `uvec2 importonCell(uint slot)` and `uvec4 importonPoint(uint index)` before including this file.
#ifndef IMPORTON_LIB_IMPORTANCE_GLSL
#define IMPORTON_LIB_IMPORTANCE_GLSL
#include "lib/grid.glsl"
#include "lib/map_point.glsl"
#include "lib/sampling.glsl"

const uint kImportonCandidates = 12u;  // of a cell that are looked at

/// Importons of the finest cell around a point that has any with a like normal; kNone where none is near.
struct NearImportons {
  uint nearest;
  uint first;  // the same for the whole cell
};

/// `levels`: a bit for each grid level in use.
NearImportons importonsAt(GridFrame frame, uint levels, vec3 position, vec3 normal) {
  while (levels != 0u) {
    const uint level = uint(findMSB(levels));
    levels ^= 1u << level;
    const ivec3 cell = gridCellOf(frame, position, level);
    const uvec2 range = importonCell(gridSlot(frame, cell, level));
    const uint end = min(range.y, range.x + kImportonCandidates);
    const float edge = gridCellEdge(frame, level);
    float least = 3.0e38;
    NearImportons found = NearImportons(kNone, kNone);
    for (uint i = range.x; i < end; ++i) {
      const uvec4 point = importonPoint(i);
      const vec3 p = uintBitsToFloat(point.xyz);
      if (mapPointLevel(point.w) != level) continue;
      const vec3 offset = p - position;
      if (maxComponent(abs(offset)) > edge) continue;  // of another cell that shares the slot
      const float d2 = dot(offset, offset);
      if (d2 < least && hasLikeNormal(point.w, normal, 0.7)) {
        least = d2;
        found = NearImportons(i, min(found.first, i));
      }
    }
    if (found.first != kNone) return found;
  }
  return NearImportons(kNone, kNone);
}

/// The importon whose importance holds at a point.
uint importonAt(GridFrame frame, uint levels, vec3 position, vec3 normal) {
  return importonsAt(frame, levels, position, normal).nearest;
}

#endif
