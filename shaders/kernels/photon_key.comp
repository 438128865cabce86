#version 460
// Cells of the stored photons. While the map is built they lie at the level of their quota radius; the finished
// map puts them one level coarser, at that of the lookup radius, which is twice as large.
#extension GL_GOOGLE_include_directive : require
#include "bindings/photons.glsl"
#include "lib/grid.glsl"
#include "lib/map_point.glsl"

layout(scalar, binding = kBindingKeysOut) writeonly buffer KeysBlock { uint keys[]; };
layout(push_constant, scalar) uniform PushBlock { PhotonKeyPush push; };

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterStored]) return;
  MapPoint point = photonPoints[i];
  const uint own = mapPointLevel(point.packed);
  const uint level = own - min(own, push.levelShift);
  if (push.levelShift != 0u) photonPoints[i].packed = withMapPointLevel(point.packed, level);
  const GridFrame frame = GridFrame(params.gridOrigin, params.gridExtent, push.slotMask);
  atomicOr(counters[kCounterStoredLevels], 1u << level);
  keys[i] = gridSlot(frame, gridCellOf(frame, point.position, level), level);
}
