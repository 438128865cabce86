// Searches a grid in steps that keep the lanes of a SIMD unit together: first the ranges of points in all cells that
// the search touches, then a walk over the points of all ranges, one after the other:
//   Walk walk = beginWalk(frame, levels, centre, normal, radius, radius);
//   while (nextPoint(walk)) { ... walk.index, walk.offset ... }
// Where nothing bounds the points, a walk is thinned: thin().
// The kernel defines `uvec2 gridCell(uint slot)` (first point, end) and `uvec4 gridPoint(uint index)` before
// including this file.
#ifndef IMPORTON_LIB_GRID_SEARCH_GLSL
#define IMPORTON_LIB_GRID_SEARCH_GLSL
#include "lib/grid.glsl"
#include "lib/map_point.glsl"

const uint kMaxRanges = 88u;  // 4³ cells of the finer level, 3³ or less of the others, less those off the plane
uvec2 searchRanges[kMaxRanges];  // first point; count, and level from bit 27 on

struct Walk {
  vec3 centre;
  uint ranges;     // in all
  uint range;      // the next one
  uint left;       // points left in the range at work
  uint level;      // of the range at work
  uint stride;     // points for which each stands
  uint index;      // of the point at hand, in cell order
  uint packed;     // of the point at hand
  vec3 offset;     // from the centre to it
};

/// Components in cyclic order, `order` places on, and back.
vec3 turned(vec3 v, uint order) { return order == 0u ? v : (order == 1u ? v.zxy : v.yzx); }
vec3 turnedBack(vec3 v, uint order) { return order == 0u ? v : (order == 1u ? v.yzx : v.zxy); }

/// Adds the non-empty cells of a level that touch the box of `radius` around `centre` and the slab around its plane:
/// columns along the normal's largest component, and in each the one to three cells that the slab passes.
uint addRanges(GridFrame frame, vec3 centre, vec3 normal, float radius, uint level, uint count) {
  // With the largest component last: x and y say which column, z how high.
  const vec3 a = abs(normal);
  const uint order = a.z >= max(a.x, a.y) ? 0u : (a.y >= a.x ? 1u : 2u);
  const float perLength = float(1u << level) / frame.extent;
  const vec3 c = turned((centre - frame.origin) * perLength, order), n = turned(normal, order);
  const float r = radius * perLength;
  const ivec3 low = ivec3(floor(c - r)), high = ivec3(floor(c + r));
  const vec2 slope = n.xy / n.z;
  const float reach = 0.2501 * r / abs(n.z) + 0.5001 * (abs(slope.x) + abs(slope.y));
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      const float middle = c.z - dot(slope, vec2(x, y) + 0.5 - c.xy);
      const int last = min(int(floor(middle + reach)), high.z);
      for (int z = max(int(floor(middle - reach)), low.z); z <= last; ++z) {
        const uvec2 cell = gridCell(gridSlot(frame, ivec3(turnedBack(vec3(x, y, z), order)), level));
        if (cell.y > cell.x && count < kMaxRanges) searchRanges[count++] = uvec2(cell.x, cell.y - cell.x | level << 27);
      }
    }
  }
  return count;
}

/// Goes over the points again.
void restartWalk(inout Walk walk) {
  walk.range = 0u;
  walk.left = 0u;
}

/// Searches the levels of the bits set in `levels`.
Walk beginWalkLevels(GridFrame frame, vec3 centre, vec3 normal, float radius, uint levels) {
  Walk walk;
  walk.centre = centre;
  walk.stride = 1u;
  walk.ranges = 0u;
  for (; levels != 0u; levels &= levels - 1u)
    walk.ranges = addRanges(frame, centre, normal, radius, uint(findLSB(levels)), walk.ranges);
  restartWalk(walk);
  return walk;
}

/// Searches within `radius` for points whose own radius is within a factor of two of `ownRadius`. `levels`: a bit for
/// each level that the grid has points on.
Walk beginWalk(GridFrame frame, uint levels, vec3 centre, vec3 normal, float radius, float ownRadius) {
  const uint own = 2u << gridLevel(frame, ownRadius);  // a bit up, so that the level below has one too
  return beginWalkLevels(frame, centre, normal, radius, levels & ((own >> 2) | (own >> 1) | own));
}

/// Searches the cell of `centre` on one level only: a cheap first look.
Walk beginWalkCell(GridFrame frame, vec3 centre, uint level) {
  Walk walk;
  walk.centre = centre;
  walk.stride = 1u;
  const uvec2 cell = gridCell(gridSlot(frame, gridCellOf(frame, centre, level), level));
  searchRanges[0] = uvec2(cell.x, cell.y - cell.x | level << 27);
  walk.ranges = uint(cell.y > cell.x);
  restartWalk(walk);
  return walk;
}

/// Steps to the next point, not yet tested for its level or distance; false when all are done.
bool nextPoint(inout Walk walk) {
  if (walk.left == 0u) {
    if (walk.range == walk.ranges) return false;
    const uvec2 range = searchRanges[walk.range++];
    walk.index = range.x - 1u;
    walk.left = range.y & 0x07FFFFFFu;
    walk.level = range.y >> 27;
  }
  ++walk.index;
  --walk.left;
  const uvec4 point = gridPoint(walk.index);
  walk.offset = uintBitsToFloat(point.xyz) - walk.centre;
  walk.packed = point.w;
  return true;
}

/// Keeps one point in `stride` on average, those of each range side by side from a place that is as good as random, so
/// that they are about `most` or fewer. Each then stands for `stride` points. Some devices end the loops of an
/// invocation after 65,535 turns in all, without a word, those of a SIMD unit counted together.
void thin(inout Walk walk, uint most) {
  uint points = 0u;
  for (uint i = 0u; i < walk.ranges; ++i) points += searchRanges[i].y & 0x07FFFFFFu;
  if (points <= most) return;
  walk.stride = points / most + 1u;
  uint ranges = 0u;
  for (uint i = 0u; i < walk.ranges; ++i) {
    const uvec2 range = searchRanges[i];
    const uint count = range.y & 0x07FFFFFFu, random = hash(range.x);
    const uint kept = (count + random % walk.stride) / walk.stride;
    if (kept == 0u) continue;
    searchRanges[ranges++] = uvec2(range.x + hash(random) % (count - kept + 1u), kept | (range.y & ~0x07FFFFFFu));
  }
  walk.ranges = ranges;
}

/// False after the last point: the device has ended a loop too early.
bool isUnfinished(Walk walk) { return walk.left > 0u || walk.range < walk.ranges; }

/// True if the point at hand is of its range's level and within `radius` and the slab around the plane.
bool isInside(Walk walk, vec3 normal, float radius) {
  return dot(walk.offset, walk.offset) < radius * radius && mapPointLevel(walk.packed) == walk.level &&
         isNearPlane(normal, walk.offset, radius);
}

/// Squared distance of the point at hand, or -1 where it is outside or on another surface.
float likeDistance(Walk walk, vec3 normal, float radius) {
  return isInside(walk, normal, radius) && hasLikeNormal(walk.packed, normal, 0.7) ? dot(walk.offset, walk.offset)
                                                                                   : -1.0;
}

/// Leaves the range at work.
void skipRange(inout Walk walk) { walk.left = 0u; }

// Points that passed isInside, kept for a second loop in which all lanes have work.
const uint kMaxFound = 32u;
uint foundPoints[kMaxFound];

/// Fills foundPoints from where the walk stands until they are full or the walk is done; returns their number.
uint collectFound(inout Walk walk, vec3 normal, float radius, out bool isDone) {
  uint count = 0u;
  isDone = false;
  while (count < kMaxFound) {
    if (!nextPoint(walk)) {
      isDone = true;
      break;
    }
    if (isInside(walk, normal, radius)) foundPoints[count++] = walk.index;
  }
  return count;
}

#endif
