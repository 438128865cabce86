// Unpacks the shading attributes of a Vertex; src/scene/packing.h is the twin that packs them.
#ifndef IMPORTON_LIB_PACKING_GLSL
#define IMPORTON_LIB_PACKING_GLSL
#include "lib/octahedral.glsl"

/// Vertex::normal, which is not kNone.
vec3 unpackNormal(uint packed) { return normalize(octahedralDirection(unpackSnorm2x16(packed))); }

/// Vertex::tangent, which is not kNone: tangent in xyz; w is the sign of the bitangent, w · cross(normal, tangent).
vec4 unpackTangent(uint packed) {
  const float x = float(int(packed) >> 16) / 32767.0;
  const float y = float(int(packed << 16) >> 17) / 16383.0;
  return vec4(normalize(octahedralDirection(vec2(x, y))), (packed & 1u) != 0u ? -1.0 : 1.0);
}

/// Vertex::colorRG and colorBA: linear RGBA.
vec4 unpackColor(uint colorRG, uint colorBA) { return vec4(unpackHalf2x16(colorRG), unpackHalf2x16(colorBA)); }

#endif
