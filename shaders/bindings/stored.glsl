// The grid of stored photons, as lib/grid_search.glsl walks it.
#ifndef IMPORTON_BINDINGS_STORED_GLSL
#define IMPORTON_BINDINGS_STORED_GLSL
#include "bindings/parameters.glsl"

uniform usamplerBuffer storedCellsPairs;
uniform usamplerBuffer storedPointsTexels;
uniform usamplerBuffer storedOrderWords;

uvec2 gridCell(uint slot) { return texelFetch(storedCellsPairs, int(slot)).xy; }
uvec4 gridPoint(uint i) { return texelFetch(storedPointsTexels, int(i)); }

#include "lib/grid_search.glsl"

GridFrame storedFrame() {
  return GridFrame(params.gridOrigin, params.gridExtent, slotMaskOf(textureSize(storedCellsPairs)));
}

#endif
