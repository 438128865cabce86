// Writes the workgroup counts of an indirect dispatch behind one word that is not theirs.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"

layout(set = 0, binding = 1, scalar) writeonly buffer Arguments { uint other; uvec3 groups; };
layout(push_constant, scalar) uniform Push { uint count; uint workgroupSize; };

void main() {
  if (invocationIndex() == 0u) groups = dispatchGroups(count, workgroupSize);
}
