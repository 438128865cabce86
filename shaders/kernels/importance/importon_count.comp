#version 460
// How many importons each cell of each level holds, collisions included: a first guess of their density.
#extension GL_GOOGLE_include_directive : require
#include "bindings/selection.glsl"
#include "lib/grid.glsl"

layout(scalar) buffer CountsBlock { uint counts[]; };
layout(push_constant, scalar) uniform Push {
  uint slotMask;
} push;

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterSelected]) return;
  const vec3 position = recordPoints[selection[i]].position;
  const GridFrame frame = GridFrame(params.gridOrigin, params.gridExtent, push.slotMask);
  for (uint level = 0u; level < kGridLevels; ++level)
    atomicAdd(counts[gridSlot(frame, gridCellOf(frame, position, level), level)], 1u);
}
