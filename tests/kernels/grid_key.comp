// The cell and the level of points by their own radius, as the kernels of the maps find them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bindings/parameters.glsl"
#include "lib/grid.glsl"
#include "lib/map_point.glsl"

struct RadiusPoint {
  vec3 position;
  float radius;
  vec3 normal;
};

layout(binding = 0, scalar) readonly buffer In { RadiusPoint items[]; };
layout(binding = 1, scalar) writeonly buffer Out { MapPoint points[]; };
layout(scalar) writeonly buffer KeysBlock { uint keys[]; };
layout(push_constant, scalar) uniform Push { uint count; uint slotMask; };

void main() {
  const uint i = invocationIndex();
  if (i >= count) return;
  const GridFrame frame = GridFrame(params.gridOrigin, params.gridExtent, slotMask);
  const RadiusPoint item = items[i];
  const uint level = gridLevel(frame, item.radius);
  points[i] = MapPoint(item.position, packMapPoint(item.normal, item.normal, level));
  keys[i] = gridSlot(frame, gridCellOf(frame, item.position, level), level);
}
