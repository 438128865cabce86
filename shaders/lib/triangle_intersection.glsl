// Watertight intersection of a ray and a triangle that never takes a ray's own origin for a hit.
#ifndef IMPORTON_LIB_TRIANGLE_INTERSECTION_GLSL
#define IMPORTON_LIB_TRIANGLE_INTERSECTION_GLSL

/// Maps a point relative to the ray's origin to its offset from the ray, along the two axes in which the ray runs
/// least, and to the ray parameter beside it. Rows of a matrix with exact zeros and ones, so the result depends on
/// the point alone, and triangles that share a vertex agree on it. [Woop, Benthin, Wald 2013, Watertight
/// ray/triangle intersection]
struct RayShear {
  vec3 rowX;
  vec3 rowY;
  vec3 rowZ;
};

/// `direction` must not be zero; it need not have unit length.
RayShear makeRayShear(vec3 direction) {
  const vec3 size = abs(direction);
  const bool isX = size.x > size.y && size.x > size.z;
  const bool isY = !isX && size.y > size.z;
  const float inverse = 1.0 / (isX ? direction.x : isY ? direction.y : direction.z);
  const vec3 slope = direction * inverse;
  RayShear s;
  s.rowX = isX ? vec3(-slope.y, 1.0, 0.0) : isY ? vec3(1.0, -slope.x, 0.0) : vec3(1.0, 0.0, -slope.x);
  s.rowY = isX ? vec3(-slope.z, 0.0, 1.0) : isY ? vec3(0.0, -slope.z, 1.0) : vec3(0.0, 1.0, -slope.y);
  s.rowZ = vec3(isX ? inverse : 0.0, isY ? inverse : 0.0, isX || isY ? 0.0 : inverse);
  return s;
}

vec3 applyRayShear(RayShear s, vec3 p) {
  precise vec3 sheared;
  sheared.x = (p.x * s.rowX.x + p.y * s.rowX.y) + p.z * s.rowX.z;
  sheared.y = (p.x * s.rowY.x + p.y * s.rowY.y) + p.z * s.rowY.z;
  sheared.z = (p.x * s.rowZ.x + p.y * s.rowZ.y) + p.z * s.rowZ.z;
  return sheared;
}

/// min and max without their rules for NaN, which cost two more instructions on CPUs.
vec3 lesser(vec3 a, vec3 b) { return mix(b, a, lessThan(a, b)); }
vec3 greater(vec3 a, vec3 b) { return mix(b, a, greaterThan(a, b)); }

/// What intersectTriangle found.
struct TriangleHit {
  bool isHit;
  float t;  // ray parameter, > 0
  float u;  // barycentric weight of v1
  float v;  // barycentric weight of v2
};

/// Where the line of a ray meets the plane of a triangle.
struct PlaneHit {
  float t;
  bool isClear;  // the origin is off the plane by more than rounding can pretend
};

/// With a = v1 - v0, b = v2 - v0, r = v0 - origin:
///   |fl((a×b)·r) - (a×b)·r| <= 8 · 2^-24 · sum over axes of (|a_j b_k| + |a_k b_j|) |r_i|
/// which is least if v0 is the vertex opposite the longest edge (makeBvhTriangle in src/accel turns it so).
PlaneHit intersectPlane(vec3 r, vec3 direction, vec3 a, vec3 b) {
  const vec3 left = a.yzx * b.zxy, right = a.zxy * b.yzx;
  const vec3 normal = left - right;
  const float height = dot(normal, r);
  const float bound = (8.0 / 16777216.0) * dot(abs(left) + abs(right), abs(r));
  return PlaneHit(height / dot(normal, direction), abs(height) > bound);
}

/// Both sides are hit, edges included. Two triangles that share an edge agree on which side of it the ray passes:
/// the edge function of one is exactly the negative of the other's. A triangle that doesn't lie well ahead of the
/// origin counts only if the origin is clear of its plane: a ray never hits the surface that it leaves. t comes
/// from the plane, which is exact for needles too, but never leaves the triangle's range, which holds it where the
/// plane is seen edge-on. Nothing here has a unit: a scene scaled by a power of two has the same u and v, bit for
/// bit, and t scaled.
TriangleHit intersectTriangle(RayShear shear, vec3 origin, vec3 direction, vec3 v0, vec3 v1, vec3 v2) {
  const float kAhead = 1.0 / 1024.0;
  const vec3 p0 = applyRayShear(shear, v0 - origin);
  const vec3 p1 = applyRayShear(shear, v1 - origin);
  const vec3 p2 = applyRayShear(shear, v2 - origin);
  precise vec3 area;  // twice the signed areas opposite v0, v1, v2, as the ray sees them
  area.x = p2.x * p1.y - p2.y * p1.x;
  area.y = p0.x * p2.y - p0.y * p2.x;
  area.z = p1.x * p0.y - p1.y * p0.x;
  // Small triangles that are seen edge-on from afar have areas that round to zero: the ray must pass through the
  // rectangle around the triangle too, which any triangle that it truly meets fulfils exactly.
  const vec3 low = lesser(lesser(p0, p1), p2), high = greater(greater(p0, p1), p2);
  const bool isNear = low.x <= 0.0 && low.y <= 0.0 && high.x >= 0.0 && high.y >= 0.0;
  const bool isInside = isNear && ((area.x >= 0.0 && area.y >= 0.0 && area.z >= 0.0) ||
                                   (area.x <= 0.0 && area.y <= 0.0 && area.z <= 0.0));
  const float total = area.x + area.y + area.z;
  const float inverseTotal = 1.0 / total;

  const PlaneHit plane = intersectPlane(v0 - origin, direction, v1 - v0, v2 - v0);
  const bool isAhead = low.z > kAhead * high.z;
  TriangleHit hit;
  hit.t = min(max(plane.t, low.z), high.z);
  hit.u = area.y * inverseTotal;
  hit.v = area.z * inverseTotal;
  hit.isHit = isInside && total != 0.0 && (isAhead || (plane.isClear && plane.t > 0.0)) && hit.t > 0.0;
  return hit;
}

#endif
