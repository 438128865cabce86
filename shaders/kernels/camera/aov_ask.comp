#version 460
// Asks for a lookup of the map at work at the surface in the middle of each pixel.
#extension GL_GOOGLE_include_directive : require
#include "bindings/scene.glsl"
#include "bindings/paths.glsl"
#include "bindings/film.glsl"

layout(scalar) writeonly buffer EyeVerticesBlock { EyeVertex eyeVertices[]; };
layout(push_constant, scalar) uniform Push {
  uint count;     // pixels of the tile
  uint isGlobal;
} push;

void main() {
  const uint slot = invocationIndex();
  if (slot >= push.count) return;
  const Ray ray = rayAt(slot);
  const Hit hit = hitAt(slot);
  pathLight[slot].caustic = vec3(0.0);
  paths[slot].flags = 0u;
  if (hit.triangle == kNone) return;
  const Surface s = loadSurface(hit.triangle, vec2(hit.u, hit.v), ray.direction);
  paths[slot].flags = kPathLookup | (push.isGlobal != 0u ? kPathLookupGlobal : 0u);
  eyeVertices[slot] = EyeVertex(s.position, 0.0, vec3(1.0), hit.triangle, ray.direction, hit.u, hit.v);
}
