// The grid of stored photons, as lib/grid_search.glsl walks it.
#ifndef IMPORTON_BINDINGS_STORED_GLSL
#define IMPORTON_BINDINGS_STORED_GLSL
#include "bindings/parameters.glsl"

uniform usamplerBuffer storedCells;
uniform usamplerBuffer storedPoints;
uniform usamplerBuffer storedOrder;

uvec2 gridCell(uint slot) { return texelFetch(storedCells, int(slot)).xy; }
uvec4 gridPoint(uint i) { return texelFetch(storedPoints, int(i)); }

#include "lib/grid_search.glsl"

GridFrame storedFrame() {
  return GridFrame(params.gridOrigin, params.gridExtent, slotMaskOf(textureSize(storedCells)));
}

#endif
