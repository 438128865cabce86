// The importon that speaks for a point, of a map in which all cells of all levels share one slot.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/scene_data.h"
#include "lib/dispatch.glsl"

struct Query {
  vec3 position;
  vec3 normal;
  vec3 importon;        // where the map's importon is of this number
  vec3 importonNormal;
  uint importonLevel;
};
struct Answer {
  uint nearest, first;
};

layout(binding = 0, scalar) readonly buffer In { Query items[]; };
layout(binding = 1, scalar) writeonly buffer Out { Answer results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

uvec2 importonCell(uint slot) { return uvec2(0u, count); }
uvec4 importonPoint(uint i);
#include "lib/importance.glsl"

uvec4 importonPoint(uint i) {
  const Query q = items[i];
  return uvec4(floatBitsToUint(q.importon), packMapPoint(vec3(0.0, 0.0, 1.0), q.importonNormal, q.importonLevel));
}

void main() {
  const uint i = invocationIndex();
  if (i >= count) return;
  const GridFrame frame = GridFrame(vec3(0.0), 1.0, 63u);
  const NearImportons found = importonsAt(frame, (1u << 3) | (1u << 5), items[i].position, items[i].normal);
  results[i] = Answer(found.nearest, found.first);
}
