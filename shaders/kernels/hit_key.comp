#version 460
// Required density at each hit of the map at work, and its cell in the grid of the batch.
#extension GL_GOOGLE_include_directive : require
#include "bindings/importance.glsl"
#include "bindings/selection.glsl"

layout(scalar, binding = kBindingKeysOut) writeonly buffer KeysBlock { uint keys[]; };
layout(push_constant, scalar) uniform PushBlock { HitKeyPush push; };

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterSelected]) return;
  MapPoint point = recordPoints[selection[i]];
  float density;
  if (push.isGlobal != 0u) density = requiredDensity(params.globalMap, point.position, mapPointNormal(point.packed));
  else density = requiredDensity(params.causticMap, point.position, mapPointNormal(point.packed));
  const GridFrame frame = GridFrame(params.gridOrigin, params.gridExtent, push.slotMask);
  const uint level = gridLevel(frame, quotaRadius(density));
  point.packed = withMapPointLevel(point.packed, level);
  required[i] = density;
  selectedPoints[i] = point;
  keys[i] = gridSlot(frame, gridCellOf(frame, point.position, level), level);
  keep[i] = uint(push.isControlled == 0u);
  atomicOr(counters[kCounterLevels], 1u << level);
}
