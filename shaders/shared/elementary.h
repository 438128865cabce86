// Elementary functions, which Vulkan lets every driver compute in its own way: here from sums, products, quotients and
// roots alone, so that they have the same bits on each, and on the host. Kernels may not use GLSL's own
// (src/gpu/modules/portable_arithmetic.h). Errors beside each are the largest that tests/kernels/elementary_test.cpp
// finds, in units in the last place (ulp) of the result or absolute. Reductions of arguments in several words after
// [Cody and Waite 1980, Software Manual for the Elementary Functions]; polynomials with the coefficients of
// [Moshier 1989, Methods and Programs for Mathematical Functions] for single precision.
#ifndef IMPORTON_SHARED_ELEMENTARY_H
#define IMPORTON_SHARED_ELEMENTARY_H
#include "glsl_compat.h"

#ifdef __cplusplus
#define SHARED_FUNCTION inline
namespace importon::elementary {
using glm::abs;
using glm::clamp;
using glm::floatBitsToInt;
using glm::floor;
using glm::intBitsToFloat;
using glm::max;
using glm::min;
using glm::sqrt;
#else
#define SHARED_FUNCTION
#endif

/// Of -126 .. 127.
SHARED_FUNCTION float powerOfTwo(int exponent) { return intBitsToFloat((exponent + 127) << 23); }

/// The float next to x; drivers need not round integers above 2^24 so.
SHARED_FUNCTION float portableFloat(uint x) { return float(x >> 16) * 65536.0f + float(x & 0xFFFFu); }

/// (cosine, sine) of x in radians, |x| <= 6000; beyond, anything within -1 .. 1. Absolute error 1e-7.
SHARED_FUNCTION vec2 portableCosSin(float x) {
  const float bounded = clamp(x, -1e4f, 1e4f);
  const float turns = floor(bounded * 0.63661977f + 0.5f);  // quarters
  const float r = ((bounded - turns * 1.5703125f) - turns * 4.837512969970703125e-4f) - turns * 7.549789954891882e-8f;
  const float z = r * r;
  const float s = ((-1.9515295891e-4f * z + 8.3321608736e-3f) * z - 1.6666654611e-1f) * z * r + r;
  const float c =
      ((2.443315711809948e-5f * z - 1.388731625493765e-3f) * z + 4.166664568298827e-2f) * z * z - 0.5f * z + 1.0f;
  const int quarter = int(turns);
  const bool isOdd = (quarter & 1) != 0;
  const float cosine = isOdd ? s : c, sine = isOdd ? c : s;
  return vec2(((quarter + 1) & 2) != 0 ? -cosine : cosine, (quarter & 2) != 0 ? -sine : sine);
}

SHARED_FUNCTION float portableCos(float x) { return portableCosSin(x).x; }
SHARED_FUNCTION float portableSin(float x) { return portableCosSin(x).y; }

/// exp(r) 2^k for |r| <= 0.35, k in -124 .. 128.
SHARED_FUNCTION float scaledExp(float r, float k) {
  const float p = ((((1.9875691500e-4f * r + 1.3981999507e-3f) * r + 8.3334519073e-3f) * r + 4.1665795894e-2f) * r +
                   1.6666665459e-1f) *
                      r +
                  5.0000001201e-1f;
  return (p * r * r + r + 1.0f) * powerOfTwo(int(k) - 1) * 2.0f;
}

/// 0 below -86, infinity above 88.7. 2 ulp.
SHARED_FUNCTION float portableExp(float x) {
  const float bounded = clamp(x, -86.0f, 88.75f);
  const float k = floor(bounded * 1.44269504f + 0.5f);
  return x < -86.0f ? 0.0f : scaledExp((bounded - k * 0.693359375f) - k * -2.12194440e-4f, k);
}

/// Exact where x is whole. 0 below -124, infinity from 128 on. 2 ulp.
SHARED_FUNCTION float portableExp2(float x) {
  const float bounded = clamp(x, -124.0f, 128.0f);
  const float k = floor(bounded + 0.5f);
  return x < -124.0f ? 0.0f : scaledExp((bounded - k) * 0.69314718f, k);
}

/// (log(m), e) of x = m 2^e, m in sqrt(1/2) .. sqrt(2), for x > 0; what is less than the least normal number counts as
/// that.
SHARED_FUNCTION vec2 logParts(float x) {
  const int bits = floatBitsToInt(max(x, 1.17549435e-38f));
  const float half_ = intBitsToFloat((bits & 0x007fffff) | 0x3f000000);  // 0.5 .. 1
  const bool isLow = half_ < 0.70710678f;
  const float e = float((bits >> 23) - (isLow ? 127 : 126));
  const float t = isLow ? half_ + half_ - 1.0f : half_ - 1.0f;
  const float z = t * t;
  float p = ((7.0376836292e-2f * t - 1.1514610310e-1f) * t + 1.1676998740e-1f) * t - 1.2420140846e-1f;
  p = (((p * t + 1.4249322787e-1f) * t - 1.6668057665e-1f) * t + 2.0000714765e-1f) * t - 2.4999993993e-1f;
  p = (p * t + 3.3333331174e-1f) * t * z;
  return vec2(t + (p - 0.5f * z), e);
}

/// Natural logarithm of x > 0. 2 ulp, and 1e-7 near 1.
SHARED_FUNCTION float portableLog(float x) {
  const vec2 parts = logParts(x);
  return (parts.x + parts.y * -2.12194440e-4f) + parts.y * 0.693359375f;
}

/// Binary logarithm of x > 0, exact for powers of two.
SHARED_FUNCTION float portableLog2(float x) {
  const vec2 parts = logParts(x);
  return parts.x * 1.44269504f + parts.y;
}

/// x^y for x >= 0 and y > 0. Relative error 1e-7 (1 + |y log2(x)|).
SHARED_FUNCTION float portablePow(float x, float y) { return x > 0.0f ? portableExp2(y * portableLog2(x)) : 0.0f; }

/// Angle of (x, y) in -pi .. pi; of (0, 0): 0.
SHARED_FUNCTION float portableAtan(float y, float x) {
  const float least = min(abs(x), abs(y)), most = max(abs(x), abs(y));
  const bool isFar = least > 0.41421356f * most;  // than an eighth of pi
  const float t = (isFar ? least - most : least) / max(isFar ? least + most : most, 1.17549435e-38f);
  const float z = t * t;
  const float p = ((8.05374449538e-2f * z - 1.38776856032e-1f) * z + 1.99777106478e-1f) * z - 3.33329491539e-1f;
  float angle = p * z * t + t;
  if (isFar) angle = angle + 0.78539816f;
  if (abs(y) > abs(x)) angle = 1.57079633f - angle;
  if (x < 0.0f) angle = 3.14159265f - angle;
  return y < 0.0f ? -angle : angle;
}

/// Of x in -1 .. 1: 0 .. pi.
SHARED_FUNCTION float portableAcos(float x) {
  const float a = abs(x);
  const bool isFar = a > 0.5f;
  const float z = isFar ? 0.5f * (1.0f - a) : a * a;
  const float t = isFar ? sqrt(z) : a;
  const float p = (((4.2163199048e-2f * z + 2.4181311049e-2f) * z + 4.5470025998e-2f) * z + 7.4953002686e-2f) * z +
                  1.6666752422e-1f;
  const float arc = p * z * t + t;  // sine's
  if (isFar) return x < 0.0f ? 3.14159265f - 2.0f * arc : 2.0f * arc;
  return x < 0.0f ? 1.57079633f + arc : 1.57079633f - arc;
}

#ifdef __cplusplus
}  // namespace importon::elementary
#else
vec3 portableCos(vec3 x) { return vec3(portableCos(x.x), portableCos(x.y), portableCos(x.z)); }
vec3 portableSin(vec3 x) { return vec3(portableSin(x.x), portableSin(x.y), portableSin(x.z)); }
vec3 portableExp(vec3 x) { return vec3(portableExp(x.x), portableExp(x.y), portableExp(x.z)); }
vec3 portablePow(vec3 x, float y) { return vec3(portablePow(x.x, y), portablePow(x.y, y), portablePow(x.z, y)); }
#endif
#endif
