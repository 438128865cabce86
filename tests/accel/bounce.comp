#version 460
// Walkers that bounce inside a closed surface, through traceClosest and the offset of origins.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"
#include "lib/hash.glsl"
#include "lib/offset.glsl"
#include "shared/elementary.h"
#include "shared/scene_data.h"

struct Corners {
  vec3 v0, v1, v2;
};

layout(scalar, binding = 0) readonly buffer TrianglesBlock { Corners triangles[]; };
layout(scalar, binding = 1) writeonly buffer BouncesBlock { uint bounces[]; };  // until the walker escaped
layout(binding = 2) uniform usamplerBuffer bvhTexels;
layout(push_constant, scalar) uniform Push {
  uint count;
  uint most;  // bounces
  vec3 start;
} push;

uvec4 bvhNodeTexel(uint index) { return texelFetch(bvhTexels, int(index)); }
uvec4 instanceTexel(uint index) { return uvec4(0u); }
bool acceptHit(uint stored, uint number, vec2 barycentrics, uint rayId) { return true; }

#include "lib/traverse.glsl"

vec3 randomDirection(uint walker, uint bounce) {
  const uint a = hashCombine(walker, bounce);
  const float z = 2.0 * unitFloat(a) - 1.0, phi = 6.2831853 * unitFloat(hash(a)), r = sqrt(max(0.0, 1.0 - z * z));
  return vec3(r * portableCosSin(phi), z);
}

void main() {
  const uint walker = invocationIndex();
  if (walker >= push.count) return;
  vec3 origin = push.start, direction = randomDirection(walker, 0u);
  uint bounce = 0u;
  while (bounce < push.most) {
    const Hit hit = traceClosest(origin, direction, 1.0 / 0.0, walker);
    if (hit.triangle == kNone) break;
    const Corners t = triangles[hit.triangle];
    const HitPosition at = hitPosition(t.v0, t.v1, t.v2, hit.u, hit.v);
    vec3 normal = normalize(cross(t.v1 - t.v0, t.v2 - t.v0));
    if (dot(normal, direction) > 0.0) normal = -normal;
    ++bounce;
    direction = randomDirection(walker, bounce);
    if (dot(direction, normal) < 0.0) direction = -direction;
    origin = offsetOrigin(at.position, at.error, normal, direction);
  }
  bounces[walker] = bounce;
}
