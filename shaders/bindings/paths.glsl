// Rays, hits and path states by slot, and the queue of slots at work.
#ifndef IMPORTON_BINDINGS_PATHS_GLSL
#define IMPORTON_BINDINGS_PATHS_GLSL
#include "bindings/parameters.glsl"

layout(scalar) buffer RaysBlock { Ray rays[]; };
uniform usamplerBuffer raysTexels;
uniform usamplerBuffer hitsTexels;
layout(scalar) buffer PathsBlock { PathState paths[]; };
layout(scalar) buffer QueueBlock { uint queue[]; };
layout(scalar) buffer KeepBlock { uint keep[]; };

Ray rayAt(uint slot) {
  const vec4 a = uintBitsToFloat(texelFetch(raysTexels, int(2u * slot)));
  const uvec4 b = texelFetch(raysTexels, int(2u * slot + 1u));
  return Ray(a.xyz, a.w, uintBitsToFloat(b.xyz), b.w);
}

Hit hitAt(uint slot) {
  const uvec4 h = texelFetch(hitsTexels, int(slot));
  return Hit(uintBitsToFloat(h.x), uintBitsToFloat(h.y), uintBitsToFloat(h.z), h.w);
}

#endif
