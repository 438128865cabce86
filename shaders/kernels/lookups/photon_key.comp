#version 460
// Cells of the stored photons: while the map is built, at the level of their quota radius; when it is finished, at
// that of the radius with which it will be read there.
#extension GL_GOOGLE_include_directive : require
#include "bindings/importance.glsl"
#include "bindings/photons.glsl"

layout(scalar) writeonly buffer KeysBlock { uint keys[]; };
layout(push_constant, scalar) uniform Push {
  uint isFinished;
  uint isGlobal;
  uint slotMask;
} push;

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterStored]) return;
  MapPoint point = photonPoints[i];
  const GridFrame frame = GridFrame(params.gridOrigin, params.gridExtent, push.slotMask);
  uint level = mapPointLevel(point.packed);
  if (push.isFinished != 0u) {
    MapSettings map = params.causticMap;
    if (push.isGlobal != 0u) map = params.globalMap;
    level = gridLevel(frame, lookupRadius(map, lookupDensity(map, point.position, mapPointNormal(point.packed))));
    photonPoints[i].packed = withMapPointLevel(point.packed, level);
  }
  atomicOr(counters[kCounterStoredLevels], 1u << level);
  keys[i] = gridSlot(frame, gridCellOf(frame, point.position, level), level);
}
