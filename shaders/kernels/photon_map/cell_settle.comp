#version 460
// Tells each cell which photon was stored for it.
#extension GL_GOOGLE_include_directive : require
#include "bindings/photon_cells.glsl"

layout(scalar) readonly buffer HomesBlock { uint homes[]; };
layout(scalar) readonly buffer AcceptedBlock { uint accepted[]; };
layout(push_constant, scalar) uniform Push {
  uint capacity;
} push;

void main() {
  const uint k = invocationIndex();
  if (k >= counters[kCounterAccepted]) return;
  const uint photon = counters[kCounterStored] + k;
  if (photon >= push.capacity) return;  // no room
  photonCells[homes[accepted[k]]].photon = photon;
}
