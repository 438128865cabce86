#version 460
// Appends the accepted hits to the stored photons.
#extension GL_GOOGLE_include_directive : require
#include "bindings/photons.glsl"
#include "bindings/selection.glsl"

layout(scalar) readonly buffer AcceptedBlock { uint accepted[]; };
layout(push_constant, scalar) uniform Push {
  uint capacity;
  uint isWeighted;  // power times the weight that photon_thin noted
} push;

void main() {
  const uint k = invocationIndex();
  if (k >= counters[kCounterAccepted]) return;
  const uint photon = counters[kCounterStored] + k;
  if (photon >= push.capacity) {
    atomicAdd(counters[kCounterOverflow], 1u);
    return;
  }
  const uint i = accepted[k];
  photonPoints[photon] = selectedPoints[i];
  vec3 flux = records[selection[i]].flux * params.fluxScale;
  if (push.isWeighted != 0u) flux *= required[i];
  for (uint c = 0u; c < 3u; ++c) {
    const uvec2 units = fixedFromFloat(flux[c]);
    photonFlux[6u * photon + 2u * c] = units.x;
    photonFlux[6u * photon + 2u * c + 1u] = units.y;
  }
}
