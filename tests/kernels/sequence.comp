// Points of the random sequences, and long indices.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"
#include "lib/sequence.glsl"

struct Key {
  uint seed, stream, index, pair;
};

layout(binding = 0, scalar) readonly buffer In { Key items[]; };
layout(binding = 1, scalar) writeonly buffer Out { vec2 results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() {
  const uint i = invocationIndex();
  if (i >= count) return;
  const Key k = items[i];
  if (k.pair == 0xFFFFFFFFu) {  // both words of item `index` from (seed, stream) on
    results[i] = vec2(longIndex(uvec2(k.seed, k.stream), k.index));
    return;
  }
  results[i] = sequencePoint(hashCombine(k.seed, k.stream), k.index, k.pair);
}
