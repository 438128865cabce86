// Owen-scrambled Sobol points in padded pairs of dimensions: each pair has its own shuffle of the index and its
// own scramble, all keyed, so any sample can be had by itself. [Burley 2020, Practical Hash-based Owen Scrambling]
#ifndef IMPORTON_LIB_SEQUENCE_GLSL
#define IMPORTON_LIB_SEQUENCE_GLSL
#include "lib/hash.glsl"

/// Owen scramble of a number whose bits stand reversed. [Burley 2020, listing 3, constants of Vegdahl 2021]
uint scrambleReversed(uint x, uint seed) {
  x ^= x * 0x3D20ADEAu;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526C56u;
  x ^= x * 0x53A22864u;
  return x;
}

/// Second dimension of the Sobol sequence, with bits reversed as it comes from the usual recurrence.
uint sobolSecond(uint index) {
  uint result = 0u;
  for (uint v = 0x80000000u; index != 0u; index >>= 1, v ^= v >> 1)
    if ((index & 1u) != 0u) result ^= v;
  return result;
}

/// Point `index` of the pair of dimensions `pair` of the sequence `stream`, in [0, 1)².
vec2 sequencePoint(uint stream, uint index, uint pair) {
  const uint seed = hashCombine(stream, pair);
  const uint shuffled = bitfieldReverse(scrambleReversed(bitfieldReverse(index), seed));
  const uint x = bitfieldReverse(scrambleReversed(shuffled, hash(seed ^ 0xA511E9B3u)));
  const uint y = bitfieldReverse(scrambleReversed(bitfieldReverse(sobolSecond(shuffled)), hash(seed ^ 0x63D83595u)));
  return vec2(unitFloat(x), unitFloat(y));
}

/// Item `item` from `first` on, counted over all passes: low words in x. It may be a negative number.
uvec2 longIndex(uvec2 first, uint item) {
  uint carry;
  const uint low = uaddCarry(first.x, item, carry);
  return uvec2(low, first.y + carry - (item >> 31));
}

/// The stream for a long index: those past the 2^32 points of one sequence go on in others.
uint streamFor(uint stream, uvec2 index) { return index.y == 0u ? stream : hashCombine(stream, index.y); }

#endif
