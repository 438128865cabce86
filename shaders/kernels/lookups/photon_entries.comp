#version 460
// Keys of the entries of all stored photons at all levels that the search for the nearest ones may look at.
#extension GL_GOOGLE_include_directive : require
#include "bindings/importon_entries.glsl"
#include "bindings/photons.glsl"
#include "lib/grid.glsl"

layout(scalar) writeonly buffer KeysBlock { uint keys[]; };
layout(push_constant, scalar) uniform Push {
  uint slotMask;
  uint levels;
} push;

void main() {
  const uint entry = invocationIndex();
  const uint perPhoton = uint(bitCount(push.levels));
  if (entry >= counters[kCounterEntries]) return;
  const vec3 position = photonPoints[entry / perPhoton].position;
  const uint level = levelOfEntry(push.levels, entry % perPhoton);
  const GridFrame frame = GridFrame(params.gridOrigin, params.gridExtent, push.slotMask);
  keys[entry] = gridSlot(frame, gridCellOf(frame, position, level), level);
}
