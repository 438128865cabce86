#version 460
// Counts the hits of a pilot batch in cells: what a pass is going to bring where.
#extension GL_GOOGLE_include_directive : require
#include "bindings/expected.glsl"
#include "bindings/selection.glsl"

layout(push_constant, scalar) uniform Push {
  uint isGlobal;
} push;

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterSelected]) return;
  const MapPoint point = recordPoints[selection[i]];
  const vec3 normal = mapPointNormal(point.packed);
  MapSettings map = params.causticMap;
  if (push.isGlobal != 0u) map = params.globalMap;
  const NearImportons importons = importonsAt(importonFrame(), map.importonLevels, point.position, normal);
  float area;
  const uint slot = findCell(
      expectedCell(point.position, normal, requiredDensityAt(map, importons.first) / params.densityScale, area));
  if (slot != kNone) atomicAdd(photonCells[slot].photon, 1u);
}
