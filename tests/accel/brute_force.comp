#version 460
// Every ray against every triangle with the intersection routine of the traversal.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/bvh_data.h"
#include "shared/ray_data.h"
#include "shared/scene_data.h"
#include "lib/dispatch.glsl"
#include "lib/triangle_intersection.glsl"

layout(scalar, binding = 0) readonly buffer RaysBlock { Ray rays[]; };
layout(scalar, binding = 1) writeonly buffer HitsBlock { Hit hits[]; };
layout(binding = 2) uniform usamplerBuffer trianglesTexels;  // BvhTriangle, three each
layout(push_constant, scalar) uniform Push { uint count; uint triangleCount; } push;

void main() {
  const uint i = invocationIndex();
  if (i >= push.count) return;
  const Ray ray = rays[i];
  const RayShear shear = makeRayShear(ray.direction);
  Hit best = Hit(ray.tMax, 0.0, 0.0, kNone);
  for (uint n = 0u; n < push.triangleCount; ++n) {
    const int texel = int(3u * n);
    const uvec4 a = texelFetch(trianglesTexels, texel), b = texelFetch(trianglesTexels, texel + 1),
                c = texelFetch(trianglesTexels, texel + 2);
    const TriangleHit hit = intersectTriangle(shear, ray.origin, ray.direction, uintBitsToFloat(a.xyz),
                                              uintBitsToFloat(b.xyz), uintBitsToFloat(c.xyz));
    if (hit.isHit && (hit.t < best.t || (hit.t == best.t && a.w < best.triangle)))
      best = Hit(hit.t, hit.u, hit.v, a.w);
  }
  hits[i] = best;
}
