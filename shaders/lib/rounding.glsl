// Quotients and square roots rounded to the nearest float, as IEEE 754 has them, from estimates that are off by a few
// units in the last place, which is all that Vulkan promises: whole numbers tell what is left of them.
#ifndef IMPORTON_LIB_ROUNDING_GLSL
#define IMPORTON_LIB_ROUNDING_GLSL

uint significandOf(float x) { return (floatBitsToUint(x) & 0x7FFFFFu) | 0x800000u; }  // 2^23 .. 2^24
int exponentOf(float x) { return int((floatBitsToUint(x) >> 23) & 255u) - 127; }
/// Neither zero, denormal, infinite nor NaN.
bool isNormal(float x) { return exponentOf(x) > -127 && exponentOf(x) < 128; }

/// significand 2^(exponent - 23), for a significand of 2^23 to 2^24 inclusive; what is less than the least normal
/// number is zero.
float assembled(int exponent, uint significand) {
  const int bits = (exponent + 127) * 8388608 + int(significand - 8388608u);
  return bits < 8388608 ? 0.0 : uintBitsToFloat(min(uint(bits), 0x7F800000u));
}

/// A step towards a quotient by n, if what is left of it allows.
void advanceQuotient(uint n, uint step, inout uint q, inout uint left) {
  const bool isOver = left >= step * n;
  left -= isOver ? step * n : 0u;
  q += isOver ? step : 0u;
}

void advanceRoot(uint step, inout uint q, inout uint left) {
  const uint more = 2u * q * step + step * step;
  const bool isOver = left >= more;
  left -= isOver ? more : 0u;
  q += isOver ? step : 0u;
}

/// a / b of normal numbers; `ratio`: that of their significands, to within 6 units in the last place.
float quotientNear(float a, float b, float ratio) {
  const uint m = significandOf(a), n = significandOf(b);
  const bool isLow = m < n;
  // A bit more than a float has, rounded down: 2^24 .. 2^25. From below, so that all steps are upwards; no loop, as
  // some drivers count turns.
  uint q = uint(ratio * (isLow ? 33554432.0 : 16777216.0)) - 32u;
  uint left = (m << (isLow ? 25 : 24)) - q * n;  // modulo 2^32; less than 64 n
  advanceQuotient(n, 32u, q, left);
  advanceQuotient(n, 16u, q, left);
  advanceQuotient(n, 8u, q, left);
  advanceQuotient(n, 4u, q, left);
  advanceQuotient(n, 2u, q, left);
  advanceQuotient(n, 1u, q, left);
  const uint up = q & uint(left != 0u || (q & 2u) != 0u);  // ties to even
  const int exponent = max(exponentOf(a) - exponentOf(b) - (isLow ? 1 : 0), -200);
  const float magnitude = exponent > 127 ? uintBitsToFloat(0x7F800000u) : assembled(exponent, (q >> 1) + up);
  return uintBitsToFloat(floatBitsToUint(magnitude) | ((floatBitsToUint(a) ^ floatBitsToUint(b)) & 0x80000000u));
}

/// What is left of x > 0 without an even power of two: 1 .. 4.
float radicandOf(float x) {
  return uintBitsToFloat((floatBitsToUint(x) & 0x7FFFFFu) | uint(127 + (exponentOf(x) & 1)) << 23);
}

/// Root of a normal x > 0; `root`: that of radicandOf(x), to within 6 units in the last place.
float rootNear(float x, float root) {
  const uint m = significandOf(x) << (exponentOf(x) & 1);
  uint q = uint(root * 16777216.0) - 32u;  // 2^24 .. 2^25
  uint left = (m << 25) - q * q;  // modulo 2^32; less than 112 q
  advanceRoot(32u, q, left);
  advanceRoot(16u, q, left);
  advanceRoot(8u, q, left);
  advanceRoot(4u, q, left);
  advanceRoot(2u, q, left);
  advanceRoot(1u, q, left);
  return assembled(exponentOf(x) >> 1, (q >> 1) + (q & 1u));  // no root lies half-way between floats
}

/// a / b, from what the device makes of it. Parameters that are const are values, not pointers, in SPIR-V.
float roundedQuotient(const float a, const float b) {
  if (!isNormal(a) || !isNormal(b)) return a / b;
  return quotientNear(a, b, float(significandOf(a)) / float(significandOf(b)));
}

float roundedRoot(const float x) {
  if (!isNormal(x) || x < 0.0) return sqrt(x);
  return rootNear(x, sqrt(radicandOf(x)));
}

#endif
