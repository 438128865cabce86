#version 460
// Tells each cell which photon was stored for it.
#extension GL_GOOGLE_include_directive : require
#include "bindings/photon_cells.glsl"

layout(scalar, binding = kBindingNeighbours) readonly buffer HomesBlock { uint homes[]; };
layout(scalar, binding = kBindingNextQueue) readonly buffer AcceptedBlock { uint accepted[]; };
layout(scalar, binding = kBindingPhotonSlots) writeonly buffer SlotsBlock { uint photonSlots[]; };

void main() {
  const uint k = invocationIndex();
  if (k >= counters[kCounterAccepted]) return;
  const uint photon = counters[kCounterStored] + k, slot = homes[accepted[k]];
  if (photon >= uint(photonSlots.length())) return;  // no room
  photonCells[slot].photon = photon;
  photonSlots[photon] = slot;
}
