// Ray origins that are surely on the right side of the surface they leave. [Pharr et al. 2016, PBRT,
// section 3.9]
#ifndef IMPORTON_LIB_OFFSET_GLSL
#define IMPORTON_LIB_OFFSET_GLSL

/// A point on a triangle and how far, per axis, rounding may have moved it off the triangle's plane, m.
struct HitPosition {
  vec3 position;
  vec3 error;
};

/// The point with barycentric weights u of v1 and v of v2. With edges a = v1 - v0 and b = v2 - v0, the sum of
/// four roundings of u·a and v·b and one of the result, each 2^-24 relative; doubled, for the rounding of the
/// bound and of what offsetOrigin makes of it.
HitPosition hitPosition(vec3 v0, vec3 v1, vec3 v2, float u, float v) {
  const float kRounding = 1.0 / 16777216.0;
  const vec3 along = u * (v1 - v0), across = v * (v2 - v0);
  HitPosition hit;
  hit.position = v0 + (along + across);
  hit.error = (2.0 * kRounding) * (abs(hit.position) + 4.0 * (abs(along) + abs(across)));
  return hit;
}

/// The next float from x in the direction of `sign`.
float nextFloat(float x, float sign) {
  if (x == 0.0) return sign < 0.0 ? -1e-37 : 1e-37;
  const int bits = floatBitsToInt(x);
  return intBitsToFloat((x < 0.0) == (sign < 0.0) ? bits + 1 : bits - 1);
}

/// Moves `position` along the normal (unit length, either side) to the side of the surface that `direction`
/// goes to, out of its error box.
vec3 offsetOrigin(vec3 position, vec3 error, vec3 normal, vec3 direction) {
  const float distance = dot(abs(normal), error);
  const vec3 offset = normal * (dot(direction, normal) < 0.0 ? -distance : distance);
  const vec3 moved = position + offset;
  return vec3(offset.x == 0.0 ? moved.x : nextFloat(moved.x, offset.x),
              offset.y == 0.0 ? moved.y : nextFloat(moved.y, offset.y),
              offset.z == 0.0 ? moved.z : nextFloat(moved.z, offset.z));
}

#endif
