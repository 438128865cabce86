// Ray origins that are surely on the right side of the surface they leave. [Pharr et al. 2016, PBRT,
// section 3.9]
#ifndef IMPORTON_LIB_OFFSET_GLSL
#define IMPORTON_LIB_OFFSET_GLSL

/// A point on a triangle and how far, per axis, rounding may have moved it, m.
struct HitPosition {
  vec3 position;
  vec3 error;
};

/// The point with these barycentric weights of v1 and v2. With edges a = v1 - v0 and b = v2 - v0, the sum of
/// four roundings of u·a and v·b and one of the result, each 2^-24 relative; doubled, for the rounding of the
/// bound and of what offsetOrigin makes of it.
HitPosition pointOnTriangle(vec3 v0, vec3 a, vec3 b, vec2 uv) {
  const float kRounding = 1.0 / 16777216.0;
  const vec3 along = uv.x * a, across = uv.y * b;
  HitPosition hit;
  hit.position = v0 + (along + across);
  hit.error = (2.0 * kRounding) * (abs(hit.position) + 4.0 * (abs(along) + abs(across)));
  return hit;
}

/// Weights of a point moved at right angles to the edges that it is too near to, each weight by what it lacks: along
/// the height on its edge, whose foot shares out among the other two weights what they lose. Stops at other edges.
vec3 moveOffEdges(vec3 a, vec3 b, vec3 weights, vec3 lack) {
  const vec3 c = b - a;
  const float ab = dot(a, b);
  const vec3 squares = max(vec3(dot(c, c), dot(b, b), dot(a, a)), vec3(1e-30));
  const float foot0 = dot(b, c) / squares.x;  // share of v1; of v2 below
  const float foot1 = ab / squares.y, foot2 = ab / squares.z;
  const float moveU = lack.y - lack.x * foot0 - lack.z * foot2;
  const float moveV = lack.z - lack.x * (1.0 - foot0) - lack.y * foot1;
  const vec3 moves = vec3(-moveU - moveV, moveU, moveV);
  const vec3 rooms = mix(vec3(1.0), -weights / moves, lessThan(moves, vec3(0.0)));
  return max(weights + min(min(rooms.x, rooms.y), min(rooms.z, 1.0)) * moves, vec3(0.0));
}

/// Weights that keep a point inside the triangle's edges by `margin` per axis. A weight falls off from its
/// vertex by its gradient. Where a triangle is hardly larger than the margin, points stay within a sixteenth of
/// their place; at the tips of needles within a few margins, where more would move them along the needle.
vec2 keepInsideEdges(vec3 a, vec3 b, vec2 uv, vec3 margin) {
  const float kMostMargins = 8.0;
  const vec3 normal = cross(a, b);
  const float square = dot(normal, normal);
  if (!(square > 0.0)) return uv;
  const vec3 gradientU = cross(b, normal) / square, gradientV = cross(normal, a) / square;
  const vec3 wanted =
      vec3(dot(abs(gradientU + gradientV), margin), dot(abs(gradientU), margin), dot(abs(gradientV), margin));
  const vec3 least = min(wanted, vec3(1.0 / 16.0));
  const vec3 inside = max(vec3(1.0 - uv.x - uv.y, uv), vec3(0.0));
  const vec3 moved = moveOffEdges(a, b, inside, max(least - inside, vec3(0.0)));
  const float most = kMostMargins * sqrt(dot(margin, margin) / max(dot(a, a), dot(b, b)));
  const vec3 weights = max(moved, min(least, vec3(most)));
  return weights.yz / (weights.x + weights.y + weights.z);
}

/// The point with barycentric weights u of v1 and v of v2, moved off the edges if it is so near that a ray from
/// it could miss another surface that meets them: by its error, and by the height over that surface from which
/// intersectTriangle is sure of a hit, taking it for as large as this triangle.
HitPosition hitPosition(vec3 v0, vec3 v1, vec3 v2, float u, float v) {
  const float kSureHeight = 32.0 / 16777216.0;  // of the surface's size
  const vec3 a = v1 - v0, b = v2 - v0;
  const HitPosition there = pointOnTriangle(v0, a, b, vec2(u, v));
  const vec3 margin = 2.0 * there.error + kSureHeight * sqrt(max(dot(a, a), dot(b, b)));
  return pointOnTriangle(v0, a, b, keepInsideEdges(a, b, vec2(u, v), margin));
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
