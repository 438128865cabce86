// The packed word of a MapPoint: direction 16 bits, normal 11, grid level 5.
#ifndef IMPORTON_LIB_MAP_POINT_GLSL
#define IMPORTON_LIB_MAP_POINT_GLSL
#include "lib/octahedral.glsl"

/// `direction`: where the particle came from; `normal`: geometric, on the side that it hit.
uint packMapPoint(vec3 direction, vec3 normal, uint level) {
  return packOctahedral(direction, 8u, 8u) | (packOctahedral(normal, 6u, 5u) << 16) | (level << 27);
}

vec3 mapPointDirection(uint packed) { return unpackOctahedral(packed & 0xFFFFu, 8u, 8u); }
vec3 mapPointNormal(uint packed) { return unpackOctahedral((packed >> 16) & 0x7FFu, 6u, 5u); }
uint mapPointLevel(uint packed) { return packed >> 27; }
uint withMapPointLevel(uint packed, uint level) { return (packed & 0x07FFFFFFu) | (level << 27); }

/// True if a packed normal is within acos(cosine) of `normal` (unit).
bool hasLikeNormal(uint packed, vec3 normal, float cosine) {
  const vec3 n = octahedralDirection(unpackOctahedralSquare((packed >> 16) & 0x7FFu, 6u, 5u));
  const float d = dot(n, normal);
  return d > 0.0 && d * d > cosine * cosine * dot(n, n);
}

/// For density estimation a point lies on the surface of the estimate's centre if it is near the tangent plane and
/// their normals are within about 26 degrees. `offset`: from the centre to the point.
bool isNearPlane(vec3 normal, vec3 offset, float radius) { return abs(dot(offset, normal)) < 0.25 * radius; }
const float kLikeNormal = 0.9;

#endif
