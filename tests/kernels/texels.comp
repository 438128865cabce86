// Reads one texel of each kind at a given index.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"

layout(set = 0, binding = 0) uniform usamplerBuffer wholeTexels;
layout(set = 0, binding = 2) uniform samplerBuffer realTexels;
layout(set = 0, binding = 1, scalar) writeonly buffer Out { uvec4 asUint; vec4 asFloat; };
layout(push_constant, scalar) uniform Push { uint index; };

void main() {
  if (invocationIndex() != 0u) return;
  asUint = texelFetch(wholeTexels, int(index));
  asFloat = texelFetch(realTexels, int(index));
}
