// Declares more bindings than it uses, as kernels that share a file of declarations do.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"

struct Item {
  vec3 position;
  uint id;
};

layout(set = 0, binding = 0) uniform usamplerBuffer unusedTexels;
layout(set = 0, binding = 1, scalar) buffer Out { uint results[]; };
layout(set = 0, binding = 2, scalar) buffer Unused { Item unusedItems[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Length { uint items[]; };
layout(set = 0, binding = 4, scalar) uniform Settings { uint count; float scale; } settings;

void main() { results[0] = items.length() + settings.count; }
