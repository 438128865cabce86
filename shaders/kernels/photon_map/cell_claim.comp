#version 460
// Keeps the hits that are to be stored: of each empty cell the one of least rank.
#extension GL_GOOGLE_include_directive : require
#include "bindings/photon_cells.glsl"
#include "bindings/selection.glsl"

layout(scalar) readonly buffer HomesBlock { uint homes[]; };

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterSelected]) return;
  const uint rank = records[selection[i]].kind >> kRecordRankShift;
  const uint slot = homes[i];
  keep[i] = slot == kNone ? 0u : uint(photonCells[slot].photon == (kCellClaim | rank));
}
