#version 460
// Frees the cells of all stored photons.
#extension GL_GOOGLE_include_directive : require
#include "bindings/photon_cells.glsl"

layout(scalar, binding = kBindingPhotonSlots) readonly buffer SlotsBlock { uint photonSlots[]; };

void main() {
  const uint i = invocationIndex();
  if (i < counters[kCounterStored]) photonCells[photonSlots[i]] = PhotonCell(kNone, kNone, kNone);
}
