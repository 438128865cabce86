// Searches the stored grid: how many points it meets, the first of them, and how many ranges the search has.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bindings/stored.glsl"

struct RadiusPoint {
  vec3 position;
  float radius;
  vec3 normal;
};

layout(binding = 0, scalar) readonly buffer In { RadiusPoint items[]; };
layout(binding = 1, scalar) writeonly buffer Out { uint found[]; };  // per item: count, ranges, indices
layout(push_constant, scalar) uniform Push { uint count; uint kept; };

void main() {
  const uint i = invocationIndex();
  if (i >= count) return;
  const RadiusPoint item = items[i];
  const uint base = i * (kept + 2u);
  uint met = 0u;
  Walk walk = beginWalk(storedFrame(), 0x1FFFFFu, item.position, item.normal, item.radius, item.radius);
  while (nextPoint(walk)) {
    if (!isInside(walk, item.normal, item.radius)) continue;
    if (met < kept) found[base + 2u + met] = texelFetch(storedOrderWords, int(walk.index)).x;
    ++met;
  }
  found[base] = met;
  found[base + 1u] = walk.ranges;
}
