// Notes which lights reach which voxels.
#ifndef IMPORTON_BINDINGS_LIGHTS_SEEN_GLSL
#define IMPORTON_BINDINGS_LIGHTS_SEEN_GLSL
#include "bindings/light_tree.glsl"
#include "lib/light_voxel.glsl"

layout(scalar) buffer LightsSeenBlock { uint lightsSeenOut[]; };

/// Notes that light comes from `light` to here without a bounce.
void seeLight(uint light, vec3 position) {
  const uint group = lightGroup(params.lightCount, light);
  const uint word = 2u * lightVoxel(position, params.gridOrigin, params.gridExtent, params.lightCount) + group / 32u,
             bit = 1u << (group % 32u);
  if ((lightsSeenOut[word] & bit) == 0u) atomicOr(lightsSeenOut[word], bit);
}

#endif
