// Points drawn by a pixel filter.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"
#include "lib/pixel_filter.glsl"

struct Query {
  vec2 u;
  uint kind;
};

layout(binding = 0, scalar) readonly buffer In { Query items[]; };
layout(binding = 1, scalar) writeonly buffer Out { vec2 results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() {
  const uint i = invocationIndex();
  if (i < count) results[i] = pixelPoint(items[i].kind, items[i].u);
}
