// Required density and the radii that follow from it.
#ifndef IMPORTON_LIB_DENSITY_GLSL
#define IMPORTON_LIB_DENSITY_GLSL
#include "lib/sampling.glsl"

/// Radius of the disc that holds `photons` at `density` (photons/m²), within what the grid can search.
float radiusHolding(float photons, float density, float gridExtent) {
  const float r = sqrt(photons / (kPi * max(density, 1e-30)));
  return clamp(r, gridExtent * 4.76837158203125e-7, gridExtent * 0.25);  // 2^-21, 2^-2
}

/// Epanechnikov kernel per unit area at squared distance d2, normalised on the disc of radius r.
float epanechnikov(float d2, float r) { return max(0.0, 2.0 * (1.0 - d2 / (r * r))) / (kPi * r * r); }

#endif
