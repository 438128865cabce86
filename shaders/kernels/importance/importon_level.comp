#version 460
// The level at which the search for M importons starts: the finest one whose cell holds a third of them.
#extension GL_GOOGLE_include_directive : require
#include "bindings/selection.glsl"
#include "lib/grid.glsl"

layout(scalar) readonly buffer CountsBlock { uint counts[]; };
layout(scalar) writeonly buffer StartLevelsBlock { uint startLevels[]; };
layout(push_constant, scalar) uniform Push {
  uint slotMask;
  uint nearest;
} push;

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterSelected]) return;
  const vec3 position = recordPoints[selection[i]].position;
  const GridFrame frame = GridFrame(params.gridOrigin, params.gridExtent, push.slotMask);
  // Counts hold collisions, so a level is believed only if the next coarser one has as many too.
  const uint enough = push.nearest / 3u + 1u;
  uint level = kGridLevels - 1u;
  uint count = counts[gridSlot(frame, gridCellOf(frame, position, level), level)];
  while (level > 0u) {
    const uint coarser = counts[gridSlot(frame, gridCellOf(frame, position, level - 1u), level - 1u)];
    if (min(count, coarser) >= enough) break;
    count = coarser;
    --level;
  }
  startLevels[i] = level;
  // The next coarser level stands by for cells that a surface only cuts.
  atomicOr(counters[kCounterLevels], (1u << level) | (1u << (level > 0u ? level - 1u : 0u)));
}
