#version 460
// Required density at each hit of the map at work, and its cell in the grid of the batch; counts the hits near each
// importon, for the passes to come.
#extension GL_GOOGLE_include_directive : require
#include "bindings/importance.glsl"
#include "bindings/selection.glsl"

layout(scalar) writeonly buffer KeysBlock { uint keys[]; };
layout(scalar) buffer ImportonHitsBlock { uint hitsOut[]; };
layout(push_constant, scalar) uniform Push {
  uint isGlobal;
  uint slotMask;
  uint isControlled;
} push;

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterSelected]) return;
  MapPoint point = recordPoints[selection[i]];
  MapSettings map = params.causticMap;
  if (push.isGlobal != 0u) map = params.globalMap;
  const uint importon = importonAt(importonFrame(), map.importonLevels, point.position, mapPointNormal(point.packed));
  if (importon != kNone && params.pass < kCountingPasses) atomicAdd(hitsOut[importon], 1u);
  const float density = requiredDensityAt(map, importon);
  const GridFrame frame = GridFrame(params.gridOrigin, params.gridExtent, push.slotMask);
  const uint level = gridLevel(frame, quotaRadius(density));
  point.packed = withMapPointLevel(point.packed, level);
  required[i] = density;
  selectedPoints[i] = point;
  if (push.isControlled != 0u) keys[i] = gridSlot(frame, gridCellOf(frame, point.position, level), level);
  keep[i] = uint(push.isControlled == 0u);
  atomicOr(counters[kCounterLevels], 1u << level);
}
