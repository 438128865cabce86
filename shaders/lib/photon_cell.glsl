// Density control by cells: space is cut into cells that on a surface hold one photon at the required density, and
// of all hits in a cell one is stored and receives the power of the others. A cell is told by its level, its place,
// the rough direction of the surface's normal and, on a glossy surface, that of the light, so that only like photons
// go together.
#ifndef IMPORTON_LIB_PHOTON_CELL_GLSL
#define IMPORTON_LIB_PHOTON_CELL_GLSL
#include "lib/hash.glsl"
#include "shared/elementary.h"

const uint kLevelsPerOctave = 8u;  // cell edges come in steps of 2^(1/8)
const uint kFinestCell = 20u;      // log2 of the most cells along the scene

struct CellKey {
  uint a;  // neither is kNone
  uint b;
};

/// Steps of cell size, from `extent` downwards, so that cells on a plane of `normal` hold at most one photon at
/// `density` (photons/m²), and at least 0.84. A unit area of plane meets |n_x|+|n_y|+|n_z| unit cubes.
uint cellLevel(float extent, vec3 normal, float density) {
  const float cubes = abs(normal.x) + abs(normal.y) + abs(normal.z);
  const float steps = ceil(0.5 * float(kLevelsPerOctave) * portableLog2(max(density * extent * extent / cubes, 1.0)));
  return uint(min(steps, float(kLevelsPerOctave * kFinestCell)));
}

float cellEdge(float extent, uint level) { return extent * portableExp2(-float(level) / float(kLevelsPerOctave)); }

/// A direction by its rounded components: an axis lies amid its class.
uint directionClass(vec3 direction) {
  const ivec3 c = ivec3(round(direction * 1.9)) + 2;
  return uint(c.x + 5 * c.y + 25 * c.z);
}

const uint kLightClasses = 126u;  // of directionClass, and none

/// `position` from the lowest corner of the scene.
CellKey cellKey(vec3 position, float extent, uint level, uint normalClass, uint lightClass) {
  const uvec3 cell = uvec3(max(position / cellEdge(extent, level), vec3(0.0)));
  const uint kind = level | normalClass << 8 | lightClass << 15;
  CellKey key;
  key.a = min(hash(cell.x + hash(cell.y + hash(cell.z + hash(kind)))), kNone - 1u);
  key.b = hashCombine(hashCombine(hashCombine(kind, cell.x), cell.y), cell.z) & ~1u;
  return key;
}

#endif
