#version 460
// Keys of the entries of all importons at all levels in use.
#extension GL_GOOGLE_include_directive : require
#include "bindings/selection.glsl"
#include "bindings/importon_entries.glsl"
#include "lib/grid.glsl"

layout(scalar) writeonly buffer KeysBlock { uint keys[]; };
layout(push_constant, scalar) uniform Push {
  uint slotMask;
  uint levels;
} push;

void main() {
  const uint entry = invocationIndex();
  const uint perImporton = uint(bitCount(push.levels));
  if (entry >= counters[kCounterEntries]) return;
  const vec3 position = recordPoints[selection[entry / perImporton]].position;
  const uint level = levelOfEntry(push.levels, entry % perImporton);
  const GridFrame frame = GridFrame(params.gridOrigin, params.gridExtent, push.slotMask);
  keys[entry] = gridSlot(frame, gridCellOf(frame, position, level), level);
}
