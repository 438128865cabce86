#version 460
// Rays that leave a point of a triangle, against the same triangle.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"
#include "lib/offset.glsl"
#include "lib/triangle_intersection.glsl"

struct Leaving {
  vec3 v0, v1, v2;  // as in the scene
  float u, v;
  vec3 direction;
  uint turn;  // of the triangle's record
};
struct Outcome {
  uint hitsAgain;
  vec3 origin;
};

layout(scalar, binding = 0) readonly buffer In { Leaving leaving[]; };
layout(scalar, binding = 1) writeonly buffer Out { Outcome outcomes[]; };
layout(push_constant) uniform Push { uint count; } push;

void main() {
  const uint i = invocationIndex();
  if (i >= push.count) return;
  const Leaving l = leaving[i];
  const HitPosition hit = hitPosition(l.v0, l.v1, l.v2, l.u, l.v);
  const vec3 normal = normalize(cross(l.v1 - l.v0, l.v2 - l.v0));
  const vec3 origin = offsetOrigin(hit.position, hit.error, normal, l.direction);
  const vec3 corners[5] = vec3[](l.v0, l.v1, l.v2, l.v0, l.v1);
  const TriangleHit again = intersectTriangle(makeRayShear(l.direction), origin, l.direction, corners[l.turn],
                                              corners[l.turn + 1u], corners[l.turn + 2u]);
  outcomes[i] = Outcome(again.isHit ? 1u : 0u, origin);
}
