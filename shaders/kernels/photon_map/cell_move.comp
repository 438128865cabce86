#version 460
// Takes the cells of a table that became too small over into a larger one.
#extension GL_GOOGLE_include_directive : require
#include "bindings/photon_cells.glsl"

layout(scalar) readonly buffer OldCellsBlock { PhotonCell oldCells[]; };

void main() {
  const uint i = invocationIndex();
  if (i >= uint(oldCells.length())) return;
  const PhotonCell cell = oldCells[i];
  if (cell.keyA == kNone) return;
  CellKey key;
  key.a = cell.keyA;
  key.b = cell.keyB;
  const uint slot = findCell(key);
  if (slot != kNone) photonCells[slot].photon = cell.photon;
}
