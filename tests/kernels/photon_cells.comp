// Slots of cells in the table of photon cells.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bindings/photon_cells.glsl"

layout(scalar) readonly buffer In { uvec2 items[]; };
layout(scalar) writeonly buffer Out { uint results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() {
  const uint i = invocationIndex();
  if (i < count) results[i] = findCell(CellKey(items[i].x, items[i].y));
}
