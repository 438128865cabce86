// Counts how often each index of the dispatch is run; indices past the count fall into the last word.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"

layout(set = 0, binding = 1, scalar) buffer Visits { uint visits[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() { atomicAdd(visits[min(invocationIndex(), count)], 1u); }
