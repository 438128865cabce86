// What comes back of a direction, a normal and a level packed into a word.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"
#include "lib/map_point.glsl"

struct Plain {
  vec3 direction;
  vec3 normal;
  uint level;
};
struct Unpacked {
  vec3 direction;
  vec3 normal;
  uint level;
  uint levelAfterChange;
  vec3 directionAfterChange;
  uint isLikeSelf;  // the packed normal is like the true one
  uint isLikeOpposite;  // and like that of the other side
};

layout(binding = 0, scalar) readonly buffer In { Plain items[]; };
layout(binding = 1, scalar) writeonly buffer Out { Unpacked results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() {
  const uint i = invocationIndex();
  if (i >= count) return;
  const Plain p = items[i];
  const uint packed = packMapPoint(p.direction, p.normal, p.level);
  const uint changed = withMapPointLevel(packed, 20u - p.level);
  results[i] = Unpacked(mapPointDirection(packed), mapPointNormal(packed), mapPointLevel(packed),
                        mapPointLevel(changed), mapPointDirection(changed),
                        uint(hasLikeNormal(packed, p.normal, kLikeNormal)),
                        uint(hasLikeNormal(packed, -p.normal, kLikeNormal)));
}
