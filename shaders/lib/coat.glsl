// KHR_materials_clearcoat: a dielectric layer of index 1.5 over the whole surface, with a roughness and a normal of its
// own. It turns light back on the way in or out, whichever is more; what that takes from the base beyond the way out is
// given back by a cosine lobe, so that a coated white surface stays white and the layers together are reciprocal.
#ifndef IMPORTON_LIB_COAT_GLSL
#define IMPORTON_LIB_COAT_GLSL
#include "lib/albedo.glsl"
#include "lib/fresnel.glsl"
#include "lib/ggx.glsl"
#include "lib/surface.glsl"

const float kCoatF0 = 0.04;
const float kMostCoatAdjoint = 4.0;  // bound where the coat's normal contradicts the shading normal

struct Coat {
  float share;     // of the surface that is coated
  float alpha;
  bool isSmooth;
  bool isBehind;   // the ray's side is the inner one of a coated solid
  bool isAdjoint;  // photons are scattered
  vec3 normal;     // in the frame of the shading normal
  float cosOut;    // of the direction that the BSDF was made for, at `normal`
  float missed;    // of light that the microfacets scatter more than once, the share that comes back
  float missOut;   // share of light along wo that is scattered more than once, over the mean of all directions
  float turnedOut; // share of light along wo that the coat turns back
  float baseAlpha;
  vec2 takenMean;  // of what it takes too much of: from metal, from diffuse light
  vec3 keptBase;   // of diffuse light and of metal: reflectance times what the coat takes too much of along wo, over
  vec3 keptMetal;  // the mean of all directions
};

Coat noCoat() {
  Coat c;
  c.share = 0.0;
  c.isSmooth = c.isBehind = c.isAdjoint = false;
  c.turnedOut = 0.0;
  return c;
}

/// Share of light that the coat, where it is, turns back along a direction.
float coatReflectance(Coat c, float cosine) {
  const vec2 albedo = c.isSmooth ? vec2(1.0, pow5(1.0 - clamp(cosine, 0.0, 1.0))) : ggxAlbedo(cosine, c.alpha);
  return c.share * layerReflectance(kCoatF0, 1.0, c.missed, albedo);
}

Coat makeCoat(Surface s, bool isBehind, vec3 diffuse, vec3 metal) {
  Coat c;
  c.share = s.coat;
  c.alpha = s.coatAlpha;
  c.isSmooth = s.coatAlpha < kSmoothAlpha;
  c.isBehind = isBehind;
  c.isAdjoint = false;
  c.normal = s.coatNormal * s.frame;
  c.cosOut = s.coatCosOut;
  c.baseAlpha = s.alpha;
  const vec2 mean_ = ggxMeanAlbedo(s.coatAlpha);
  c.missed = multipleReflectance(meanSchlick(vec3(kCoatF0), 1.0), mean_.x).x;
  c.missOut = (1.0 - ggxAlbedo(c.cosOut, s.coatAlpha).x) / max(1.0 - mean_.x, 1e-6);
  c.turnedOut = isBehind ? 0.0 : coatReflectance(c, c.cosOut);
  const vec2 taken = coatTaken(c.cosOut, s.alpha, s.coatAlpha);
  c.takenMean = max(coatMeanTaken(s.alpha, s.coatAlpha), vec2(1e-6));
  c.keptMetal = isBehind ? vec3(0.0) : metal * (c.share * taken.x / c.takenMean.x);
  c.keptBase = isBehind ? vec3(0.0) : diffuse * (c.share * taken.y / c.takenMean.y);
  return c;
}

/// Share of light between wo and wi that passes the coat, in either direction.
float coatPassed(Coat c, vec3 wi, bool isThin) {
  const float cosIn = dot(c.normal, wi);
  if (c.isBehind) return wi.z < 0.0 ? 1.0 - coatReflectance(c, -cosIn) : 1.0;
  if (wi.z < 0.0 && !isThin) return 1.0 - c.turnedOut;
  return 1.0 - max(c.turnedOut, coatReflectance(c, abs(cosIn)));
}

/// The lobe that gives back what the coat took too much of, times cosine.
vec3 evalCoatKept(Coat c, vec3 wi) {
  const vec2 taken = coatTaken(max(dot(c.normal, wi), 0.0), c.baseAlpha, c.alpha);
  return (c.keptMetal * taken.x + c.keptBase * taken.y) * (wi.z / kPi);
}

/// What turns the factor that photons take for the shading normal into the one for the coat's. [Veach 1997, eq. 5.19]
float coatAdjoint(Coat c, float cosIn, vec3 wo, vec3 wi) {
  return c.isAdjoint ? min(c.cosOut * wi.z / max(wo.z * cosIn, 1e-20), kMostCoatAdjoint) : 1.0;
}

/// Reflection of a rough coat, times the cosine at its normal: once, and more than once.
float evalCoat(Coat c, vec3 wo, vec3 wi, out float pdf) {
  const mat3 frame = frameAround(c.normal);
  const vec3 outward = wo * frame, inward = wi * frame;
  pdf = 0.0;
  if (outward.z <= 0.0 || inward.z <= 0.0) return 0.0;
  const vec3 h = normalize(outward + inward);
  const float d = ggxDistribution(h, c.alpha);
  pdf = ggxMasking(outward, c.alpha) * d / (4.0 * outward.z);
  const float single = fresnelSchlick(vec3(kCoatF0), 1.0, max(dot(outward, h), 0.0)).x *
                       (d * ggxMaskingShadowing(outward, inward, c.alpha) / (4.0 * outward.z));
  const float multiple = c.missed * c.missOut * (1.0 - ggxAlbedo(inward.z, c.alpha).x) * (inward.z / kPi);
  return c.share * (single + multiple) * coatAdjoint(c, inward.z, wo, wi);
}

/// The microfacet at which the coat reflects.
vec3 sampleCoatNormal(Coat c, vec3 wo, vec2 u) {
  if (c.isSmooth) return c.normal;
  const mat3 frame = frameAround(c.normal);
  return frame * sampleVisibleNormal(wo * frame, c.alpha, u);
}

#endif
