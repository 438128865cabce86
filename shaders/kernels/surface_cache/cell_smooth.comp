#version 460
// Irradiance to be read from each side of the cells: that of the largest group, with what its members differ by, and
// what theirs do, as far as that is more than noise. Flux is kept.
#extension GL_GOOGLE_include_directive : require
#include "bindings/cell_groups.glsl"

layout(scalar) writeonly buffer CellIrradiancesBlock { uvec4 irradianceOut[]; };
layout(push_constant, scalar) uniform Push {
  uint cells;
} push;

void main() {
  const uint i = invocationIndex();
  if (i >= 2u * push.cells) return;
  const uint cell = i / 2u, side = i % 2u;
  const CellLight light = lightOfCell(cell, side);
  vec3 inner = light.irradiance, differences = vec3(0.0);
  for (uint group = texelFetch(cellPlacesPairs, int(cell)).x, outer; group != kNone; group = outer) {
    float share;
    const vec3 mean = lightOfGroup(group, side, share, outer).irradiance;
    differences += share * (inner - mean);
    inner = mean;
  }
  const vec3 irradiance = max(inner + differences, vec3(0.0));
  irradianceOut[i] = uvec4(floatBitsToUint(irradiance), floatBitsToUint(light.area));
}
