#version 460
// The entries' points in cell order, each with its level, and the weights beside them.
#extension GL_GOOGLE_include_directive : require
#include "bindings/selection.glsl"
#include "bindings/importon_entries.glsl"
#include "lib/map_point.glsl"

layout(scalar) readonly buffer OrderBlock { uint order[]; };
layout(scalar) writeonly buffer PointsOutBlock { MapPoint pointsOut[]; };
layout(scalar) writeonly buffer WeightsBlock { float weightsOut[]; };
layout(push_constant, scalar) uniform Push {
  uint levels;
} push;

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterEntries]) return;
  const uint perImporton = uint(bitCount(push.levels));
  const uint record = selection[order[i] / perImporton];
  MapPoint point = recordPoints[record];
  point.packed = withMapPointLevel(point.packed, levelOfEntry(push.levels, order[i] % perImporton));
  pointsOut[i] = point;
  weightsOut[i] = records[record].flux.x;
}
