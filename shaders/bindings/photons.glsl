// Stored photons in the order they came: point and fixed-point flux, 40 bytes each.
#ifndef IMPORTON_BINDINGS_PHOTONS_GLSL
#define IMPORTON_BINDINGS_PHOTONS_GLSL
#include "bindings/parameters.glsl"
#include "lib/flux.glsl"

layout(scalar) buffer PhotonPointsBlock { MapPoint photonPoints[]; };
layout(scalar) buffer PhotonFluxBlock { uint photonFlux[]; };

/// Adds to a channel of a photon: exact, and the same in any order.
void addToPhoton(uint photon, uint channel, uvec2 units) {
  const uint at = 6u * photon + 2u * channel;
  const uint before = atomicAdd(photonFlux[at], units.x);
  const uint high = units.y + uint(before + units.x < before);
  if (high != 0u) atomicAdd(photonFlux[at + 1u], high);
}

uvec2 photonChannel(uint photon, uint channel) {
  return uvec2(photonFlux[6u * photon + 2u * channel], photonFlux[6u * photon + 2u * channel + 1u]);
}

#endif
