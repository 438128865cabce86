// Surface cells, the groups that they are in, and what fell in them: src/render/surface_cache/cell_tree.h.
#ifndef IMPORTON_BINDINGS_CELL_GROUPS_GLSL
#define IMPORTON_BINDINGS_CELL_GROUPS_GLSL
#include "bindings/parameters.glsl"
#include "lib/flux.glsl"

uniform usamplerBuffer cellSumsTexels;
uniform usamplerBuffer cellGroupsTexels;
uniform usamplerBuffer cellMembersWords;
uniform usamplerBuffer cellPlacesPairs;
uniform usamplerBuffer groupLightTexels;

/// Light that fell on one side of a cell or group.
struct CellLight {
  vec3 irradiance;  // photonUnits per m²
  float squares;    // sum over photons of the square of each one's flux, photonUnits²
  float area;       // m²
};

CellLight lightOfCell(uint cell, uint side) {
  const uint at = 2u * (2u * cell + side);
  const uvec4 a = texelFetch(cellSumsTexels, int(at)), b = texelFetch(cellSumsTexels, int(at + 1u));
  CellLight light;
  light.area = uintBitsToFloat(texelFetch(cellPlacesPairs, int(cell)).y);
  const vec3 flux = vec3(floatFromFixed(a.xy), floatFromFixed(a.zw), floatFromFixed(b.xy));
  light.irradiance = flux * params.photonUnits / max(light.area, 1e-30);
  light.squares = float(b.w);
  return light;
}

/// Also the share of its members' differences that is more than noise, and the group that it is in.
CellLight lightOfGroup(uint group, uint side, out float share, out uint outer) {
  const uint at = 2u * (2u * group + side);
  const uvec4 a = texelFetch(groupLightTexels, int(at)), b = texelFetch(groupLightTexels, int(at + 1u));
  share = uintBitsToFloat(a.w);
  outer = b.z;
  return CellLight(uintBitsToFloat(a.xyz), uintBitsToFloat(b.x), uintBitsToFloat(b.y));
}

#endif
