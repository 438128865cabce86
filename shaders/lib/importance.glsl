// The importon that speaks for a point: a near one with a like normal. The kernel defines
// `uvec2 importonCell(uint slot)` and `uvec4 importonPoint(uint index)` before including this file.
#ifndef IMPORTON_LIB_IMPORTANCE_GLSL
#define IMPORTON_LIB_IMPORTANCE_GLSL
#include "lib/grid.glsl"
#include "lib/map_point.glsl"
#include "lib/sampling.glsl"

const uint kImportonCandidates = 12u;  // of a cell that are looked at

/// Index of the importon whose importance holds at `position` on a surface of `normal`; kNone where none is near.
/// `levels`: a bit for each grid level in use. The finest level that holds a like importon in the cell decides.
uint importonAt(GridFrame frame, uint levels, vec3 position, vec3 normal) {
  while (levels != 0u) {
    const uint level = uint(findMSB(levels));
    levels ^= 1u << level;
    const ivec3 cell = gridCellOf(frame, position, level);
    const uvec2 range = importonCell(gridSlot(frame, cell, level));
    const uint end = min(range.y, range.x + kImportonCandidates);
    const float edge = gridCellEdge(frame, level);
    float nearest = 3.0e38;
    uint found = kNone;
    for (uint i = range.x; i < end; ++i) {
      const uvec4 point = importonPoint(i);
      const vec3 p = uintBitsToFloat(point.xyz);
      if (mapPointLevel(point.w) != level) continue;
      const vec3 offset = p - position;
      if (maxComponent(abs(offset)) > edge) continue;  // of another cell that shares the slot
      const float d2 = dot(offset, offset);
      if (d2 < nearest && hasLikeNormal(point.w, normal, 0.7)) {
        nearest = d2;
        found = i;
      }
    }
    if (found != kNone) return found;
  }
  return kNone;
}

/// Index of an importon whose importance stands for a whole cell around `position`: of those in the finest cell that
/// has any with a like normal, the first; kNone where none is near.
uint cellImportonAt(GridFrame frame, uint levels, vec3 position, vec3 normal) {
  while (levels != 0u) {
    const uint level = uint(findMSB(levels));
    levels ^= 1u << level;
    const ivec3 cell = gridCellOf(frame, position, level);
    const uvec2 range = importonCell(gridSlot(frame, cell, level));
    const uint end = min(range.y, range.x + kImportonCandidates);
    for (uint i = range.x; i < end; ++i) {
      const uvec4 point = importonPoint(i);
      if (mapPointLevel(point.w) == level && gridCellOf(frame, uintBitsToFloat(point.xyz), level) == cell &&
          hasLikeNormal(point.w, normal, 0.7))
        return i;
    }
  }
  return kNone;
}

#endif
