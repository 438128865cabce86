// The table of photon cells: open addressing, the key's two words claimed one after the other by compare and swap,
// so a slot belongs to one cell whatever the order of threads; which slot it is may differ and shows nowhere.
#ifndef IMPORTON_BINDINGS_PHOTON_CELLS_GLSL
#define IMPORTON_BINDINGS_PHOTON_CELLS_GLSL
#include "bindings/parameters.glsl"
#include "lib/photon_cell.glsl"

layout(scalar) buffer PhotonCellsBlock { PhotonCell photonCells[]; };

const uint kMostProbes = 512u;  // at a load of 0.8 no cell is so far from home

/// Slot of the cell, taken for it if it is new; kNone: the table is full.
uint findCell(CellKey key) {
  const uint slots = uint(photonCells.length());
  uint slot, low;
  umulExtended(key.a, slots, slot, low);
  for (uint probe = 0u; probe < kMostProbes; ++probe, slot = slot + 1u < slots ? slot + 1u : 0u) {
    uint a = photonCells[slot].keyA;
    if (a == kNone) a = atomicCompSwap(photonCells[slot].keyA, kNone, key.a);
    if (a != kNone && a != key.a) continue;
    uint b = photonCells[slot].keyB;
    if (b == kNone) b = atomicCompSwap(photonCells[slot].keyB, kNone, key.b);
    if (b == kNone || b == key.b) return slot;
  }
  return kNone;
}

/// Slot of the cell if it has been taken for it; kNone: it has not. For tables that no kernel changes meanwhile.
uint seekCell(CellKey key) {
  const uint slots = uint(photonCells.length());
  uint slot, low;
  umulExtended(key.a, slots, slot, low);
  for (uint probe = 0u; probe < kMostProbes; ++probe, slot = slot + 1u < slots ? slot + 1u : 0u) {
    const uint a = photonCells[slot].keyA;
    if (a == kNone) return kNone;
    if (a == key.a && photonCells[slot].keyB == key.b) return slot;
  }
  return kNone;
}

#endif
