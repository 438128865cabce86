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

/// Two points lie on the same surface, for density estimation, if their normals are within about 26 degrees
/// and the one lies near the other's tangent plane. `offset`: from the estimate's centre to the point.
bool isSameSurface(vec3 centreNormal, vec3 pointNormal, vec3 offset, float radius) {
  return dot(centreNormal, pointNormal) > 0.9 && abs(dot(offset, centreNormal)) < 0.25 * radius;
}

#endif
