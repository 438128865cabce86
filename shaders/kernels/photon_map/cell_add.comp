#version 460
// Hits that were not stored give their power to the photon of their cell.
#extension GL_GOOGLE_include_directive : require
#include "bindings/photon_cells.glsl"
#include "bindings/photons.glsl"
#include "bindings/selection.glsl"

layout(scalar) readonly buffer HomesBlock { uint homes[]; };

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterSelected] || keep[i] != 0u) return;
  const uint slot = homes[i], photon = slot == kNone ? kNone : photonCells[slot].photon;
  if (photon >= kCellClaim) {  // the cell or its photon found no room
    atomicAdd(counters[kCounterOverflow], 1u);
    return;
  }
  const vec3 flux = records[selection[i]].flux * params.fluxScale;
  for (uint c = 0u; c < 3u; ++c) addToPhoton(photon, c, fixedFromFloat(flux[c]));
}
