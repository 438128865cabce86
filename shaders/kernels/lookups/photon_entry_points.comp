#version 460
// The entries' points in cell order, each with its level, and their flux beside them.
#extension GL_GOOGLE_include_directive : require
#include "bindings/importon_entries.glsl"
#include "bindings/photons.glsl"
#include "lib/map_point.glsl"

layout(scalar) readonly buffer OrderBlock { uint order[]; };
layout(scalar) writeonly buffer PointsOutBlock { MapPoint pointsOut[]; };
layout(scalar) writeonly buffer MapFluxBlock { uvec2 fluxOut[]; };
layout(push_constant, scalar) uniform Push {
  uint slotMask;
  uint levels;
} push;

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterEntries]) return;
  const uint perPhoton = uint(bitCount(push.levels));
  const uint photon = order[i] / perPhoton;
  MapPoint point = photonPoints[photon];
  point.packed = withMapPointLevel(point.packed, levelOfEntry(push.levels, order[i] % perPhoton));
  pointsOut[i] = point;
  vec3 flux;
  for (uint c = 0u; c < 3u; ++c) flux[c] = floatFromFixed(photonChannel(photon, c));
  fluxOut[i] = packFlux(flux / params.fluxScale);
}
