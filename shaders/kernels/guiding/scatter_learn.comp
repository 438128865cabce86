#version 460
// Importance that came to a surface teaches the guide which way photons from there reach important places.
#extension GL_GOOGLE_include_directive : require
#include "bindings/selection.glsl"
#include "lib/map_point.glsl"
#include "lib/scatter_grid.glsl"

layout(scalar) buffer ScatterSumsBlock { uint sums[]; };
layout(push_constant, scalar) uniform Push {
  ScatterGrid guide;
} push;

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterSelected]) return;
  const MapPoint point = recordPoints[selection[i]];
  const vec3 normal = mapPointNormal(point.packed);
  const vec3 direction = mapPointDirection(point.packed) * scatterFrame(normal);
  if (direction.z <= 0.0) return;
  const uint cell = scatterCell(push.guide, point.position, normal);
  const uint bin = cell * kScatterBins * kScatterBins + scatterBin(squareOfHemisphere(direction));
  atomicAdd(sums[bin], uint(mean(records[selection[i]].flux) * kGuideUnits));
}
