// The lights' buffers and the accessors that lib/light.glsl asks for.
#ifndef IMPORTON_BINDINGS_LIGHTS_GLSL
#define IMPORTON_BINDINGS_LIGHTS_GLSL
#include "bindings/light_tree.glsl"
#include "bindings/scene.glsl"

layout(scalar) readonly buffer LightAliasBlock { LightAlias lightAlias[]; };
uniform usamplerBuffer environmentTexels;
uniform usamplerBuffer environmentDrawPairs;

LightAlias lightAliasAt(uint i) { return lightAlias[i]; }

uvec4 environmentTexel(uint i) { return texelFetch(environmentTexels, int(i)); }
uvec2 environmentDrawn(uint i) { return texelFetch(environmentDrawPairs, int(i)).xy; }
uvec2 environmentSize() { return params.environmentSize; }

#include "lib/light_voxel.glsl"

uniform usamplerBuffer lightsSeenPairs;

uvec2 lightsSeen(vec3 x) {
  if (!kHasGlobalMap) return uvec2(kNone);  // no photon says what reaches where
  return texelFetch(lightsSeenPairs, int(lightVoxel(x, params.gridOrigin, params.gridExtent, params.lightCount))).xy;
}

#include "lib/light.glsl"

#endif
