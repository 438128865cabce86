// The cell of a triangle at barycentric weights.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"
#include "lib/surface_cell.glsl"

struct Query {
  vec2 uv;
  uint n;
};

layout(binding = 0, scalar) readonly buffer In { Query items[]; };
layout(binding = 1, scalar) writeonly buffer Out { uint results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() {
  const uint i = invocationIndex();
  if (i < count) results[i] = cellInTriangle(items[i].uv, items[i].n);
}
