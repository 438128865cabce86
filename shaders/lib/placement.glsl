// Where the mesh of a placed triangle stands. The kernel defines `uvec4 instanceTexel(uint)` and `uint
// instanceOfPage(uint)` before including this file.
#ifndef IMPORTON_LIB_PLACEMENT_GLSL
#define IMPORTON_LIB_PLACEMENT_GLSL
#include "lib/features.glsl"
#include "lib/placed_point.glsl"
#include "shared/scene_data.h"

/// Rows of the affine map into render space, and back.
struct Placement {
  vec4 x, y, z;
  vec4 backX, backY, backZ;
  bool isMirrored;
};

Placement noPlacement() {
  Placement p;
  p.x = p.backX = vec4(1.0, 0.0, 0.0, 0.0);
  p.y = p.backY = vec4(0.0, 1.0, 0.0, 0.0);
  p.z = p.backZ = vec4(0.0, 0.0, 1.0, 0.0);
  p.isMirrored = false;
  return p;
}

/// That of the mesh of a triangle with this number; of the world, nothing is moved.
/// `stored`: its index in the scene's triangles.
Placement findPlacement(uint number, out uint stored) {
  stored = number;
  if (!kHasInstances) return noPlacement();
  const bool isPlaced = (number & kPlacedTriangle) != 0u;
  const uint instance = isPlaced ? instanceOfPage((number & ~kPlacedTriangle) >> kPageBits) : 0u;
  const uint base = kInstanceTexels * instance;
  Placement p;
  p.x = uintBitsToFloat(instanceTexel(base));
  p.y = uintBitsToFloat(instanceTexel(base + 1u));
  p.z = uintBitsToFloat(instanceTexel(base + 2u));
  p.backX = uintBitsToFloat(instanceTexel(base + 3u));
  p.backY = uintBitsToFloat(instanceTexel(base + 4u));
  p.backZ = uintBitsToFloat(instanceTexel(base + 5u));
  const uint firstNumber = instanceTexel(base + 6u).w;
  const uvec4 rest = instanceTexel(base + 7u);
  p.isMirrored = rest.z != 0u;
  stored = number - firstNumber + rest.x;
  return p;
}

vec3 placedVertex(Placement p, vec3 v) { return kHasInstances ? placedPoint(p.x, p.y, p.z, v) : v; }

/// A unit normal of a mesh in render space, by the inverse transpose.
vec3 placedNormal(Placement p, vec3 n) {
  if (!kHasInstances) return n;
  const vec3 turned = n.x * p.backX.xyz + n.y * p.backY.xyz + n.z * p.backZ.xyz;
  return turned * inversesqrt(max(dot(turned, turned), 1e-37));
}

/// A tangent of unit length with the sign of its bitangent, which a mirror turns round.
vec4 placedTangent(Placement p, vec4 t) {
  if (!kHasInstances) return t;
  const vec3 turned = vec3(dot(p.x.xyz, t.xyz), dot(p.y.xyz, t.xyz), dot(p.z.xyz, t.xyz));
  return vec4(turned * inversesqrt(max(dot(turned, turned), 1e-37)), p.isMirrored ? -t.w : t.w);
}

#endif
