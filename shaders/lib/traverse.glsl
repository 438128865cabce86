// Traversal of the bounding volume hierarchy of shared/bvh_data.h, a step at a time. A step is one record: each
// lane of a SIMD group tests the boxes of a node or a triangle, and goes on; so lanes never wait for others in
// a different phase.
//
// The kernel defines, before it includes this file:
//   uvec4 bvhNodeTexel(uint index)     texels of Bvh::nodes, three per record
//   uvec4 instanceTexel(uint index)    of InstanceData
//   bool acceptHit(uint stored, uint number, vec2 barycentrics, uint rayId)
//                                      false: the surface has a hole there; `stored`: the triangle's index in the scene
//
// Placed meshes have trees of their own, in object space. There boxes are tested with the ray in object space, widened
// by what rounding may have moved it; triangles in render space, each vertex as lib/placed_point.glsl places it, so all
// that holds of triangles of the world holds of them: no gaps, and no ray that hits the surface it leaves.
#ifndef IMPORTON_LIB_TRAVERSE_GLSL
#define IMPORTON_LIB_TRAVERSE_GLSL
#include "lib/features.glsl"
#include "lib/placed_point.glsl"
#include "lib/triangle_intersection.glsl"
#include "shared/bvh_data.h"
#include "shared/ray_data.h"
#include "shared/scene_data.h"

/// Where a traversal is. Siblings still to be visited form a list in one word: record of the first child in the
/// low bits, above them their slots, two bits each and the next one lowest, closed by a 1.
struct Traversal {
  vec3 origin;
  vec3 direction;
  vec3 inverseDirection;  // finite
  RayShear shear;
  uint rayId;
  Hit hit;        // the best so far, u and v as in its record; t is the limit from the start
  uint hitKind;   // BvhTriangle::kind of the hit
  uint record;    // to be visited next
  uint siblings;  // of `record`
  uint depth;     // lists on the stack
  // Of the mesh that it is in, or the world, where nothing is moved:
  vec4 placeX, placeY, placeZ;  // rows of renderFromObject
  vec3 boxOrigin;               // the ray in object space
  vec3 boxInverse;
  vec3 boxWiden;    // of boxes on each side, in units of t
  uint toNumber;    // from an index of a triangle to its number
  uint floorDepth;  // lists on the stack that are not of the mesh; kNone: it is the world
  uint nextMesh;    // instance to be changed to; kNone: none
};

/// Lists of siblings left behind on the way down. A variable of its own because an array in a struct would be
/// copied at each call (a factor of four on lavapipe); so an invocation has one traversal at a time.
uint bvhStack[kBvhMaxDepth];

const uint kBvhSlotMask = 3u;
const uint kBvhIndexMask = (1u << kBvhIndexBits) - 1u;
const uint kBvhNoSiblings = 1u << kBvhIndexBits;
const int kBvhMiss = 0x7FFFFFFF;
/// Relative slack of the box test: rounding in it and in the triangle test adds up to less than 24 · 2^-24.
const float kBvhSlack = 1.0 + 1.0 / 524288.0;

/// Reciprocal with the direction held away from zero, so that no product with it is NaN.
float bvhInverse(float x) {
  const float kLeast = 1.0 / 1208925819614629174706176.0;  // 2^-80
  return 1.0 / (abs(x) < kLeast ? (x < 0.0 ? -kLeast : kLeast) : x);
}

void setRay(inout Traversal t, vec3 origin, vec3 direction, float tMax, uint rayId) {
  t.origin = origin;
  t.direction = direction;
  t.inverseDirection = vec3(bvhInverse(direction.x), bvhInverse(direction.y), bvhInverse(direction.z));
  t.shear = makeRayShear(direction);
  t.hit = Hit(tMax, 0.0, 0.0, kNone);
  t.hitKind = kBvhLeaf;
  t.rayId = rayId;
  t.record = 0u;
  t.siblings = kBvhNoSiblings;
  t.depth = 0u;
  t.placeX = vec4(1.0, 0.0, 0.0, 0.0);
  t.placeY = vec4(0.0, 1.0, 0.0, 0.0);
  t.placeZ = vec4(0.0, 0.0, 1.0, 0.0);
  t.boxOrigin = t.origin;
  t.boxInverse = t.inverseDirection;
  t.boxWiden = vec3(0.0);
  t.toNumber = 0u;
  t.floorDepth = kNone;
  t.nextMesh = kNone;
}

bool isAtMesh(Traversal t) { return kHasInstances && t.nextMesh != kNone; }

/// Goes down into a placed mesh, or from one back to the world. Let N be the rows of objectFromRender, o and d the ray,
/// x any point of the placed mesh, and A what `reach` says. Rounding moves N o + T by at most 5 u N (|o| + A), u =
/// 2^-24, and t N d by 5 u N (|o| + A), as t |d| <= |x| + |o|; the vertices lie within 4 u A of where the exact map
/// takes them, which is 4 u N A here; the rest is for the box test itself.
void changeMesh(inout Traversal t) {
  const float kMoved = 32.0 / 16777216.0;
  const uint base = kInstanceTexels * t.nextMesh;
  t.placeX = uintBitsToFloat(instanceTexel(base));
  t.placeY = uintBitsToFloat(instanceTexel(base + 1u));
  t.placeZ = uintBitsToFloat(instanceTexel(base + 2u));
  const vec4 x = uintBitsToFloat(instanceTexel(base + 3u)), y = uintBitsToFloat(instanceTexel(base + 4u)),
             z = uintBitsToFloat(instanceTexel(base + 5u));
  const uvec4 reach = instanceTexel(base + 6u), rest = instanceTexel(base + 7u);
  const vec3 d = vec3(dot(x.xyz, t.direction), dot(y.xyz, t.direction), dot(z.xyz, t.direction));
  const vec3 far = abs(t.origin) + uintBitsToFloat(reach.xyz);
  const vec3 moved = kMoved * vec3(dot(abs(x.xyz), far), dot(abs(y.xyz), far), dot(abs(z.xyz), far));
  t.boxOrigin = vec3(dot(x.xyz, t.origin), dot(y.xyz, t.origin), dot(z.xyz, t.origin)) + vec3(x.w, y.w, z.w);
  t.boxInverse = vec3(bvhInverse(d.x), bvhInverse(d.y), bvhInverse(d.z));
  const bool isWorld = t.nextMesh == 0u;
  t.boxWiden = isWorld ? vec3(0.0) : moved * abs(t.boxInverse);
  t.toNumber = reach.w - rest.x;
  t.floorDepth = isWorld ? kNone : t.depth;
  t.record = isWorld ? t.record : rest.y;
  t.siblings = isWorld ? t.siblings : kBvhNoSiblings;
  t.nextMesh = kNone;
}

/// Distance at which the ray enters the box in `slot`, as an integer with the slot in its lowest bits, or
/// kBvhMiss. Non-negative floats compare as their bits do, which spares the NaN rules of min and max.
int bvhBoxKey(Traversal t, vec3 scale, vec3 offset, uvec3 nearWords, uvec3 farWords, int slot) {
  vec3 near = vec3(ivec3((nearWords >> (8 * slot)) & 255u)) * scale + offset;
  vec3 far = vec3(ivec3((farWords >> (8 * slot)) & 255u)) * scale + offset;
  if (kHasInstances) near -= t.boxWiden;
  if (kHasInstances) far += t.boxWiden;
  const ivec3 nearBits = floatBitsToInt(near);
  const ivec3 farBits = floatBitsToInt(far * kBvhSlack);
  const int enter = max(max(nearBits.x, nearBits.y), max(nearBits.z, 0));
  const int leave = min(min(farBits.x, farBits.y), min(farBits.z, floatBitsToInt(t.hit.t * kBvhSlack)));
  return enter <= leave ? (enter & ~int(kBvhSlotMask)) | slot : kBvhMiss;
}

/// Keys of the four children in the order that the ray meets them.
ivec4 bvhSortedKeys(Traversal t, uvec4 a, uvec4 b, uvec4 c) {
  const vec3 origin = kHasInstances ? t.boxOrigin : t.origin;
  const vec3 inverseDirection = kHasInstances ? t.boxInverse : t.inverseDirection;
  const vec3 offset = (uintBitsToFloat(a.xyz) - origin) * inverseDirection;
  const vec3 scale = uintBitsToFloat((uvec3(a.w << 23, a.w << 15, a.w << 7)) & 0x7F800000u) * inverseDirection;
  const bvec3 isNegative = lessThan(kHasInstances ? inverseDirection : t.direction, vec3(0.0));
  const uvec3 low = uvec3(b.x, b.z, c.x), high = uvec3(b.y, b.w, c.y);
  const uvec3 near = mix(low, high, isNegative), far = mix(high, low, isNegative);
  const int k0 = bvhBoxKey(t, scale, offset, near, far, 0), k1 = bvhBoxKey(t, scale, offset, near, far, 1);
  const int k2 = bvhBoxKey(t, scale, offset, near, far, 2), k3 = bvhBoxKey(t, scale, offset, near, far, 3);
  const int low01 = min(k0, k1), high01 = max(k0, k1), low23 = min(k2, k3), high23 = max(k2, k3);
  const int inner0 = max(low01, low23), inner1 = min(high01, high23);
  return ivec4(min(low01, low23), min(inner0, inner1), max(inner0, inner1), max(high01, high23));
}

/// The list of all but the nearest child.
uint bvhSiblingList(ivec4 keys, uint firstChild) {
  uint list = kBvhNoSiblings;
  const uvec4 slots = (uvec4(keys) & kBvhSlotMask) << kBvhIndexBits;
  list = keys.w != kBvhMiss ? (list << 2) | slots.w : list;
  list = keys.z != kBvhMiss ? (list << 2) | slots.z : list;
  list = keys.y != kBvhMiss ? (list << 2) | slots.y : list;
  return list | firstChild;
}

/// The weights of the triangle's second and third vertex in the scene from those in its record, whose vertices
/// may be turned (BvhTriangle::kind).
vec2 bvhBarycentrics(vec2 uv, uint kind) {
  const float w = 1.0 - uv.x - uv.y;
  const uint turn = kind & kBvhTurnMask;
  return turn == 0u ? uv : turn == 1u ? vec2(w, uv.x) : vec2(uv.y, w);
}

/// A vertex of a leaf record in render space.
vec3 bvhVertex(Traversal t, uvec4 texel) {
  const vec3 v = uintBitsToFloat(texel.xyz);
  return kHasInstances ? placedPoint(t.placeX, t.placeY, t.placeZ, v) : v;
}

/// Keeps the triangle of a leaf record if it is the nearest so far; of equally near ones the smallest index.
bool bvhTestTriangle(inout Traversal t, uvec4 a, uvec4 b, uvec4 c, bool isTriangle, const bool isAnyHit) {
  const TriangleHit h = intersectTriangle(t.shear, t.origin, t.direction, bvhVertex(t, a), bvhVertex(t, b),
                                          bvhVertex(t, c));
  const uint number = kHasInstances ? a.w + t.toNumber : a.w;
  const bool isNearer = isAnyHit ? h.t < t.hit.t : h.t < t.hit.t || (h.t == t.hit.t && number < t.hit.triangle);
  const bool isTaken =
      isTriangle && h.isHit && isNearer && acceptHit(a.w, number, bvhBarycentrics(vec2(h.u, h.v), c.w), t.rayId);
  t.hit.t = isTaken ? h.t : t.hit.t;
  t.hit.u = isTaken ? h.u : t.hit.u;
  t.hit.v = isTaken ? h.v : t.hit.v;
  t.hit.triangle = isTaken ? number : t.hit.triangle;
  t.hitKind = isTaken ? c.w : t.hitKind;
  return isTaken;
}

/// Visits one record. True when the traversal is over; else, where isAtMesh(t) holds after it, changeMesh(t) comes
/// before the next step. Branches are selections: lavapipe would run both sides
/// anyway, and a store that every lane makes costs less than one that some skip.
bool stepTraversal(inout Traversal t, const bool isAnyHit) {
  const uint texel = kBvhRecordTexels * t.record;
  const uvec4 a = bvhNodeTexel(texel), b = bvhNodeTexel(texel + 1u), c = bvhNodeTexel(texel + 2u);
  const bool isTriangle = (c.w & kBvhLeaf) != 0u;
  const ivec4 keys = bvhSortedKeys(t, a, b, c);
  const bool isTaken = bvhTestTriangle(t, a, b, c, isTriangle, isAnyHit);

  const bool isMesh = kHasInstances && (c.w & kBvhInstance) != 0u;
  const bool descends = !isTriangle && !isMesh && keys.x != kBvhMiss;
  const bool isChained = isTriangle && b.w != 0u;
  const bool takesSibling = !descends && !isChained && !isMesh;
  const bool hasSiblings = t.siblings >= 2u * kBvhNoSiblings;
  bvhStack[t.depth] = t.siblings;
  t.depth += (descends || isMesh) && hasSiblings ? 1u : 0u;
  const bool pops = takesSibling && !hasSiblings;
  if (kHasInstances) t.nextMesh = isMesh ? a.w : pops && t.depth == t.floorDepth ? 0u : kNone;
  const uint top = bvhStack[max(t.depth, 1u) - 1u];
  const bool isOver = (pops && t.depth == 0u) || (isAnyHit && isTaken);
  t.depth -= pops ? 1u : 0u;
  const uint list = pops ? top : t.siblings;
  const uint sibling = (list & kBvhIndexMask) + ((list >> kBvhIndexBits) & kBvhSlotMask);
  const uint rest = ((list >> 2) & ~kBvhIndexMask) | (list & kBvhIndexMask);
  t.record = descends ? c.z + (uint(keys.x) & kBvhSlotMask) : isChained ? b.w : sibling;
  t.siblings = descends ? bvhSiblingList(keys, c.z) : takesSibling ? rest : t.siblings;
  return isOver;
}

/// What a traversal found when it was over.
Hit traversalHit(Traversal t) {
  const vec2 uv = bvhBarycentrics(vec2(t.hit.u, t.hit.v), t.hitKind);
  return Hit(t.hit.t, uv.x, uv.y, t.hit.triangle);
}

/// The nearest hit with 0 < t <= tMax; of equally near triangles the one with the smallest index.
/// hit.triangle == kNone: none. `direction` need not have unit length; t is in units of it.
Hit traceClosest(vec3 origin, vec3 direction, float tMax, uint rayId) {
  Traversal t;
  setRay(t, origin, direction, tMax, rayId);
  bool isOver;
  do {
    isOver = stepTraversal(t, false);
    if (isAtMesh(t)) changeMesh(t);
  } while (!isOver);
  return traversalHit(t);
}

/// True if there is a hit with 0 < t < tMax.
bool isOccluded(vec3 origin, vec3 direction, float tMax, uint rayId) {
  Traversal t;
  setRay(t, origin, direction, tMax, rayId);
  bool isOver;
  do {
    isOver = stepTraversal(t, true);
    if (isAtMesh(t)) changeMesh(t);
  } while (!isOver);
  return t.hit.triangle != kNone;
}

#endif
