// Unit vectors on the octahedron. [Cigolle et al. 2014]
#ifndef IMPORTON_LIB_OCTAHEDRAL_GLSL
#define IMPORTON_LIB_OCTAHEDRAL_GLSL

/// To [-1, 1]².
vec2 octahedralFromVector(vec3 v) {
  const vec2 p = v.xy / (abs(v.x) + abs(v.y) + abs(v.z));
  const vec2 signs = vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
  return v.z >= 0.0 ? p : (1.0 - abs(p.yx)) * signs;
}

/// The direction at a point of the square, not normalised.
vec3 octahedralDirection(vec2 p) {
  const float z = 1.0 - abs(p.x) - abs(p.y);
  const float fold = max(-z, 0.0);
  return vec3(p.x + (p.x >= 0.0 ? -fold : fold), p.y + (p.y >= 0.0 ? -fold : fold), z);
}

/// To two unsigned numbers of the given counts of bits, x in the low ones.
uint packOctahedral(vec3 v, uint bitsX, uint bitsY) {
  const vec2 levels = vec2(float((1u << bitsX) - 1u), float((1u << bitsY) - 1u));
  const uvec2 q = uvec2((octahedralFromVector(v) * 0.5 + 0.5) * levels + 0.5);
  return q.x | (q.y << bitsX);
}

/// The point of the square that packOctahedral stored.
vec2 unpackOctahedralSquare(uint packed, uint bitsX, uint bitsY) {
  const uvec2 masks = uvec2((1u << bitsX) - 1u, (1u << bitsY) - 1u);
  return vec2(uvec2(packed, packed >> bitsX) & masks) * (2.0 / vec2(masks)) - 1.0;
}

vec3 unpackOctahedral(uint packed, uint bitsX, uint bitsY) {
  return normalize(octahedralDirection(unpackOctahedralSquare(packed, bitsX, bitsY)));
}

#endif
