// Notes which lights reach which voxels.
#ifndef IMPORTON_BINDINGS_LIGHTS_SEEN_GLSL
#define IMPORTON_BINDINGS_LIGHTS_SEEN_GLSL
#include "bindings/parameters.glsl"
#include "lib/light_voxel.glsl"

layout(scalar, binding = kBindingLightsSeenOut) buffer LightsSeenBlock { uint lightsSeenOut[]; };

/// Notes that light comes from `light` to here without a bounce.
void seeLight(uint light, vec3 position) {
  if (light >= 64u) return;
  const uint word = 2u * lightVoxel(position, params.gridOrigin, params.gridExtent) + light / 32u, bit = 1u << (light % 32u);
  if ((lightsSeenOut[word] & bit) == 0u) atomicOr(lightsSeenOut[word], bit);
}

#endif
