// Integer hashes and numbers in [0, 1).
#ifndef IMPORTON_LIB_HASH_GLSL
#define IMPORTON_LIB_HASH_GLSL

/// Bijective 32-bit mix (the finaliser of MurmurHash3).
uint hash(uint x) {
  x ^= x >> 16;
  x *= 0x85EBCA6Bu;
  x ^= x >> 13;
  x *= 0xC2B2AE35u;
  x ^= x >> 16;
  return x;
}

uint hashCombine(uint seed, uint x) { return hash(seed * 0x9E3779B9u + 0x7F4A7C15u ^ hash(x + 0x632BE5ABu)); }

/// Uniform in [0, 1) from the 24 high bits.
float unitFloat(uint x) { return float(x >> 8) * 5.9604644775390625e-8; }

#endif
