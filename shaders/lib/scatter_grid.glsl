// Cells of a guide for scattering: where a surface is and where it faces, and bins of its hemisphere.
#ifndef IMPORTON_LIB_SCATTER_GRID_GLSL
#define IMPORTON_LIB_SCATTER_GRID_GLSL
#include "lib/sampling.glsl"
#include "shared/elementary.h"
#include "shared/render_data.h"

uint longestAxis(vec3 n) {
  const vec3 a = abs(n);
  return a.x > a.y && a.x > a.z ? 0u : a.y > a.z ? 1u : 2u;
}

uint scatterCell(ScatterGrid grid, vec3 position, vec3 normal) {
  const vec3 at = clamp((position - grid.origin) * grid.perMetre, vec3(0.0), vec3(grid.voxels - 1u));
  const uvec3 voxel = uvec3(at);
  const uint axis = longestAxis(normal);
  const uint facing = 2u * axis + (normal[axis] < 0.0 ? 1u : 0u);
  return ((voxel.z * grid.voxels.y + voxel.y) * grid.voxels.x + voxel.x) * kScatterFacings + facing;
}

/// Orthonormal basis whose third column is the unit vector n. It turns steadily with n as long as n's longest component
/// is the same, so that directions of one cell lie in one frame.
mat3 scatterFrame(vec3 n) {
  const uint axis = longestAxis(n);
  if (axis == 2u) return frameAround(n);
  const mat3 turned = frameAround(axis == 0u ? n.yzx : n.zxy);
  if (axis == 0u) return mat3(turned[0].zxy, turned[1].zxy, n);
  return mat3(turned[0].yzx, turned[1].yzx, n);
}

/// The point of the unit square that sampleCosineHemisphere takes to a direction; the inverse of sampleDisc.
vec2 squareOfHemisphere(vec3 w) {
  const float r = length(w.xy);
  if (r == 0.0) return vec2(0.5);
  const bool isWide = abs(w.x) > abs(w.y);
  const float along = r * (isWide ? sign(w.x) : sign(w.y));
  const float across = along * (4.0 / kPi) * portableAtan(isWide ? w.y / w.x : w.x / w.y, 1.0);
  const vec2 p = isWide ? vec2(along, across) : vec2(across, along);
  return clamp(0.5 * p + 0.5, vec2(0.0), vec2(0.99999994));
}

uint scatterBin(vec2 square) {
  const uvec2 bin = uvec2(square * float(kScatterBins));
  return bin.y * kScatterBins + bin.x;
}

#endif
