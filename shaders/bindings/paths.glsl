// Rays, hits and path states by slot, and the queue of slots at work.
#ifndef IMPORTON_BINDINGS_PATHS_GLSL
#define IMPORTON_BINDINGS_PATHS_GLSL
#include "bindings/parameters.glsl"

layout(scalar, binding = kBindingRays) buffer RaysBlock { Ray rays[]; };
layout(binding = kBindingRayTexels) uniform usamplerBuffer rayTexels;
layout(binding = kBindingHitTexels) uniform usamplerBuffer hitTexels;
layout(scalar, binding = kBindingPaths) buffer PathsBlock { PathState paths[]; };
layout(scalar, binding = kBindingQueue) buffer QueueBlock { uint queue[]; };
layout(scalar, binding = kBindingKeep) buffer KeepBlock { uint keep[]; };

Ray rayAt(uint slot) {
  const vec4 a = uintBitsToFloat(texelFetch(rayTexels, int(2u * slot)));
  const uvec4 b = texelFetch(rayTexels, int(2u * slot + 1u));
  return Ray(a.xyz, a.w, uintBitsToFloat(b.xyz), b.w);
}

Hit hitAt(uint slot) {
  const uvec4 h = texelFetch(hitTexels, int(slot));
  return Hit(uintBitsToFloat(h.x), uintBitsToFloat(h.y), uintBitsToFloat(h.z), h.w);
}

#endif
