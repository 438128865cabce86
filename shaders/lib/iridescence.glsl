// KHR_materials_iridescence: a film so thin that light from its two sides interferes, over the whole surface. Sums the
// waves that are reflected inside up to twice, and what the eye's three sensitivities see of them, each fitted by
// Gaussians in the frequency. [Belcour and Barla 2017]
#ifndef IMPORTON_LIB_IRIDESCENCE_GLSL
#define IMPORTON_LIB_IRIDESCENCE_GLSL
#include "lib/fresnel.glsl"
#include "lib/sampling.glsl"
#include "shared/elementary.h"

struct Film {
  float share;      // of the surface that it covers
  float ior;
  float thickness;  // nm
};

const float kNoFilm = 0.03;  // nm, below which the film fades out; likewise one of the index of air

/// A film over a share of the surface.
Film makeFilm(float share, float ior, float thickness) {
  const float t = clamp(thickness / kNoFilm, 0.0, 1.0);  // smoothly from none
  return Film(ior > 1.0 ? share * (t * t * (3.0 - 2.0 * t)) : 0.0, ior, thickness);
}

float normalReflectance(float eta) {
  const float ratio = (eta - 1.0) / (eta + 1.0);
  return ratio * ratio;
}

/// What the eye sees of waves with a path difference of `difference` (m), in linear RGB. `shift`: of the phase, rad.
/// [Belcour and Barla 2017, eq. 10 and the supplement's fit of the CIE 1931 functions]
vec3 interference(float difference, vec3 shift) {
  const float phase = 2.0 * kPi * difference, square = phase * phase;
  const vec3 height = vec3(5.4856e-13, 4.4201e-13, 5.2481e-13), middle = vec3(1.6810e6, 1.7953e6, 2.2084e6);
  const vec3 width = vec3(4.3278e9, 9.3046e9, 6.6121e9);
  vec3 xyz = height * sqrt(2.0 * kPi * width) * portableCos(middle * phase + shift) * portableExp(-square * width);
  xyz.x += 9.7470e-14 * sqrt(2.0 * kPi * 4.5282e9) * portableCos(2.2399e6 * phase + shift.x) *
           portableExp(-square * 4.5282e9);
  xyz /= 1.0685e-7;
  return vec3(dot(vec3(3.2404542, -1.5371385, -0.4985314), xyz), dot(vec3(-0.9692660, 1.8760108, 0.0415560), xyz),
              dot(vec3(0.0556434, -0.2040259, 1.0572252), xyz));
}

/// Reflectance of the film over a base of reflectance f0 (towards air, at normal incidence), 0 to 1.
/// `cosine`: of the light in air.
vec3 filmReflectance(Film film, vec3 f0, float cosine) {
  const float ior = film.ior, cos2Inside = 1.0 - (1.0 - cosine * cosine) / (ior * ior);
  if (cos2Inside < 0.0) return vec3(1.0);
  const float cosInside = sqrt(cos2Inside);
  const float top = fresnelSchlick(vec3(normalReflectance(ior)), 1.0, cosine).x, passed = 1.0 - top;
  const vec3 root = sqrt(clamp(f0, 0.0, 0.9999)), baseIor = (1.0 + root) / (1.0 - root);
  const vec3 ratio = (baseIor - ior) / (baseIor + ior), base = fresnelSchlick(ratio * ratio, 1.0, cosInside);
  // Against a wave that is reflected by what is denser, one that is reflected by what is thinner is half a period off:
  // at the top from inside, and at some bases.
  const vec3 shift = vec3(kPi) + mix(vec3(0.0), vec3(kPi), lessThan(baseIor, vec3(ior)));
  const vec3 both = clamp(top * base, 1e-5, 0.9999);
  const vec3 returned = passed * passed * base / (1.0 - both);
  const float difference = 2.0 * ior * film.thickness * cosInside * 1e-9;
  vec3 sum = top + returned, wave = returned - passed;
  for (uint m = 1u; m <= 2u; ++m) {
    wave *= sqrt(both);
    sum += wave * (2.0 * interference(float(m) * difference, float(m) * shift));
  }
  return clamp(sum, 0.0, 1.0);
}

#endif
