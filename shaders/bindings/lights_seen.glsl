// Notes which lights reach which voxels.
#ifndef IMPORTON_BINDINGS_LIGHTS_SEEN_GLSL
#define IMPORTON_BINDINGS_LIGHTS_SEEN_GLSL
#include "bindings/parameters.glsl"

layout(scalar, binding = kBindingLightsSeenOut) buffer LightsSeenBlock { uint lightsSeenOut[]; };

layout(binding = kBindingLightTree) uniform usamplerBuffer lightTreeTexels;
uvec4 lightTreeTexel(uint i) { return texelFetch(lightTreeTexels, int(i)); }
#include "lib/light_voxel.glsl"

/// Notes that light comes from `light` to here without a bounce.
void seeLight(uint light, vec3 position) {
  const uint group = lightGroup(params.lightCount, light);
  const uint word = 2u * lightVoxel(position, params.gridOrigin, params.gridExtent, params.lightCount) + group / 32u, bit = 1u << (group % 32u);
  if ((lightsSeenOut[word] & bit) == 0u) atomicOr(lightsSeenOut[word], bit);
}

#endif
