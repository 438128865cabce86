#version 460
// The finished map's flux in cell order, as lookups read it.
#extension GL_GOOGLE_include_directive : require
#include "bindings/photons.glsl"

layout(scalar) readonly buffer OrderBlock { uint order[]; };
layout(scalar) writeonly buffer MapFluxBlock { uvec2 mapFluxOut[]; };

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterStored]) return;
  vec3 flux;
  for (uint c = 0u; c < 3u; ++c) flux[c] = floatFromFixed(photonChannel(order[i], c));
  mapFluxOut[i] = packFlux(flux / params.fluxScale);
}
