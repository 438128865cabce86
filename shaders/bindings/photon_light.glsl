// Light of a photon of the finished map, reflected towards a path.
#ifndef IMPORTON_BINDINGS_PHOTON_LIGHT_GLSL
#define IMPORTON_BINDINGS_PHOTON_LIGHT_GLSL
#include "bindings/stored.glsl"
#include "lib/bsdf.glsl"
#include "lib/flux.glsl"

uniform usamplerBuffer mapFluxPairs;

/// BSDF times flux, W/sr; to be divided by the area that the photons are taken from.
vec3 photonLight(Surface s, Bsdf b, vec3 wo, mat3 frame, uint photon, uint packed) {
  const vec3 towardsLight = mapPointDirection(packed);
  float pdf;
  // Photons count flux per area of the true surface; the BSDF's cosine is the shading normal's. The bound holds
  // where the two differ: without it one grazing photon could outshine all others.
  const vec3 wi = towardsLight * frame;
  const bool isAcross = dot(towardsLight, s.geometricNormal) <= 0.0;
  if (isTranslucent(b) && isAcross != (wi.z <= 0.0)) return vec3(0.0);
  const float cosine = max(abs(dot(towardsLight, s.geometricNormal)), min(abs(wi.z), 0.05));
  vec3 f = evalBsdf(b, wo, wi, pdf) / max(cosine, 1e-6);
  if (isTranslucent(b) && wi.z < 0.0 && !b.isThin) f /= b.eta * b.eta;  // as for all light from behind an interface
  return f * unpackFlux(texelFetch(mapFluxPairs, int(photon)).xy);
}

#endif
