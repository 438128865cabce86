// The radius that is to hold so many photons at a density, and the grid level of points of that radius.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/scene_data.h"
#include "lib/density.glsl"
#include "lib/dispatch.glsl"
#include "lib/grid.glsl"

struct Wish {
  float photons, density, extent;
};
struct Radius {
  float radius;
  uint level;
  float edge;
};

layout(binding = 0, scalar) readonly buffer In { Wish items[]; };
layout(binding = 1, scalar) writeonly buffer Out { Radius results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() {
  const uint i = invocationIndex();
  if (i >= count) return;
  const Wish w = items[i];
  const float radius = radiusHolding(w.photons, w.density, w.extent);
  const GridFrame frame = GridFrame(vec3(0.0), w.extent, 4095u);
  const uint level = gridLevel(frame, radius);
  results[i] = Radius(radius, level, gridCellEdge(frame, level));
}
