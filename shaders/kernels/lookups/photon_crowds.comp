#version 460
// How many of the stored photons share a slot of the grid at a level: those of a cell, and of others by collision.
#extension GL_GOOGLE_include_directive : require
#include "bindings/parameters.glsl"
#include "bindings/photons.glsl"
#include "lib/grid.glsl"

layout(scalar) buffer CountsBlock { uint counts[]; };
layout(push_constant, scalar) uniform Push {
  uint slotMask;
  uint level;
} push;

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterStored]) return;
  const GridFrame frame = GridFrame(params.gridOrigin, params.gridExtent, push.slotMask);
  const uint slot = gridSlot(frame, gridCellOf(frame, photonPoints[i].position, push.level), push.level);
  atomicMax(counters[kCounterLargestCrowd], atomicAdd(counts[slot], 1u) + 1u);
}
