// Reconstruction filters, by drawing camera rays with the filter's density: all samples of a pixel weigh the same, so
// none of them counts more than its light does. [Ernst, Stamminger and Greiner 2006, Filter Importance Sampling]
#ifndef IMPORTON_LIB_PIXEL_FILTER_GLSL
#define IMPORTON_LIB_PIXEL_FILTER_GLSL
#include "shared/elementary.h"
#include "shared/features.h"

const float kFilterRadius = 1.5;  // pixels, of all filters but the box
const float kGaussianSigma = 0.5;  // pixels

/// Share of the Blackman-Harris window's area left of x, in -1 .. 1 over its width, and its density there.
/// [Harris 1978]
float blackmanHarrisShare(float x, out float density) {
  const float pi = 3.14159265358979;
  const vec3 a = vec3(0.48829, 0.14128, 0.01168) / 0.35875;
  const vec3 k = pi * vec3(1.0, 2.0, 3.0);
  density = 0.5 * (1.0 + dot(a, portableCos(k * x)));
  return 0.5 * (x + 1.0 + dot(a / k, portableSin(k * x)));
}

/// A point of the window with the share u left of it: Newton's method, kept within the halves of an interval.
float drawBlackmanHarris(float u) {
  float low = -1.0, high = 1.0, x = 0.0;
  for (int i = 0; i < 12; ++i) {
    float density;
    const float share = blackmanHarrisShare(x, density);
    if (share < u) low = x;
    else high = x;
    const float step = x + (u - share) / max(density, 1e-6);
    x = step > low && step < high ? step : 0.5 * (low + high);
  }
  return x;
}

/// A place on the image relative to the pixel's upper left corner, pixels, with the density of `filter`
/// (kFilter*).
vec2 pixelPoint(uint filter_, vec2 u) {
  const float pi = 3.14159265358979;
  if (filter_ == kFilterGaussian) {  // cut off at the radius
    const float range = -0.5 * kFilterRadius * kFilterRadius / (kGaussianSigma * kGaussianSigma);
    const float r = kGaussianSigma * sqrt(-2.0 * portableLog(1.0 - u.x * (1.0 - portableExp(range))));
    return 0.5 + r * portableCosSin(2.0 * pi * u.y);
  }
  if (filter_ == kFilterBlackmanHarris)
    return 0.5 + kFilterRadius * vec2(drawBlackmanHarris(u.x), drawBlackmanHarris(u.y));
  return u;
}

#endif
