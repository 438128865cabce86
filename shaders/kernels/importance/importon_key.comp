#version 460
// Cells of the finished importance map: each site at the level where a cell holds about seven to thirty, so that
// next to none is empty where sites of two levels mix.
#extension GL_GOOGLE_include_directive : require
#include "bindings/selection.glsl"
#include "lib/grid.glsl"
#include "lib/map_point.glsl"

layout(scalar) writeonly buffer KeysBlock { uint keys[]; };
layout(push_constant, scalar) uniform Push {
  uint slotMask;
} push;

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterSites]) return;
  const GridFrame frame = GridFrame(params.gridOrigin, params.gridExtent, push.slotMask);
  const float density = required[i] / (params.importonFlux * float(kImportonsPerSite));  // sites/m²
  MapPoint point = recordPoints[selection[i * kImportonsPerSite]];
  const uint level = gridLevel(frame, 2.0 * inversesqrt(max(density, 1e-30)));
  point.packed = withMapPointLevel(point.packed, level);
  selectedPoints[i] = point;
  keys[i] = gridSlot(frame, gridCellOf(frame, point.position, level), level);
  atomicOr(counters[kCounterLevels], 1u << level);
}
