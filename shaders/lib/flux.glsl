// Flux as 64-bit fixed point in two words, and as three packed floats.
#ifndef IMPORTON_LIB_FLUX_GLSL
#define IMPORTON_LIB_FLUX_GLSL
#include "shared/elementary.h"

/// Units of flux (a non-negative whole number below 2^63): low word in x.
uvec2 fixedFromFloat(float units) {
  const float high = floor(units * 2.3283064365386963e-10);
  return uvec2(uint(units - high * 4294967296.0), uint(high));
}

float floatFromFixed(uvec2 value) { return portableFloat(value.y) * 4294967296.0 + portableFloat(value.x); }

uvec2 addFixed(uvec2 a, uvec2 b) {
  uint carry;
  const uint low = uaddCarry(a.x, b.x, carry);
  return uvec2(low, a.y + b.y + carry);
}

/// a - b for b no greater than a.
uvec2 subtractFixed(uvec2 a, uvec2 b) {
  uint borrow;
  const uint low = usubBorrow(a.x, b.x, borrow);
  return uvec2(low, a.y - b.y - borrow);
}

/// Quotient by a small number (1 .. 65535); the remainder goes to `rest`.
uvec2 divideFixed(uvec2 a, uint divisor, out uint rest) {
  const uint high = a.y / divisor;
  uint r = a.y % divisor;
  const uint upper = (r << 16) | (a.x >> 16);
  const uint middle = upper / divisor;
  r = upper % divisor;
  const uint lower = (r << 16) | (a.x & 0xFFFFu);
  rest = lower % divisor;
  return uvec2((middle << 16) | (lower / divisor), high);
}

/// Three non-negative floats in 64 bits: 8 bits of exponent and 13 of mantissa each, rounded to nearest.
uvec2 packFlux(vec3 v) {
  const uvec3 bits = (floatBitsToUint(v) + 0x200u) >> 10;  // sign is 0: 21 bits remain
  return uvec2(bits.x | (bits.y << 21), (bits.y >> 11) | (bits.z << 10));
}

vec3 unpackFlux(uvec2 p) {
  const uvec3 bits = uvec3(p.x & 0x1FFFFFu, (p.x >> 21) | ((p.y & 0x3FFu) << 11), p.y >> 10);
  return uintBitsToFloat(bits << 10);
}

#endif
