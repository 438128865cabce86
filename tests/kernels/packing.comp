// Unpacks each item as a normal, as a tangent and, with its neighbour, as a colour: 11 floats an item.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"
#include "lib/packing.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer In { uint items[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { float results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() {
  const uint index = invocationIndex();
  if (index * 11u >= count) return;
  const vec3 normal = unpackNormal(items[index]);
  const vec4 tangent = unpackTangent(items[index]);
  const vec4 color = unpackColor(items[index], items[index ^ 1u]);
  for (uint c = 0u; c < 3u; ++c) results[index * 11u + c] = normal[c];
  for (uint c = 0u; c < 4u; ++c) results[index * 11u + 3u + c] = tangent[c];
  for (uint c = 0u; c < 4u; ++c) results[index * 11u + 7u + c] = color[c];
}
