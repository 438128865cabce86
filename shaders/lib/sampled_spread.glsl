// Steps from a sampled direction to its neighbours: derivatives by the two numbers that drew it. [Suykens and Willems
// 2001, section 4.1]
#ifndef IMPORTON_LIB_SAMPLED_SPREAD_GLSL
#define IMPORTON_LIB_SAMPLED_SPREAD_GLSL
#include "lib/bsdf.glsl"
#include "shared/elementary.h"

const float kNumberStep = 1e-3;    // of differences in place of derivatives
const float kLargestSpread = 1.0;  // of a direction, rad: beyond it nothing is linear

/// Which lobe of sampleBsdf a direction came from, and where it went.
struct DrawnLobe {
  bool isCosine;
  bool isCoat;
  bool isSheen;
  bool isTransmission;
};

DrawnLobe drawnLobe(Bsdf b, float uLobe, BsdfSample s) {
  DrawnLobe lobe;
  const bool isBelow = kHasTransmission && b.pBelow > 0.0 && uLobe >= 1.0 - b.pBelow;
  lobe.isCosine = !kHasReflection || uLobe < b.pCosine || isBelow;
  lobe.isSheen = kHasSheen && !lobe.isCosine && b.pSheen > 0.0 && uLobe >= 1.0 - b.pBelow - b.pSheen;
  lobe.isCoat = kHasClearcoat && !lobe.isCosine && !lobe.isSheen && b.pCoat > 0.0 && uLobe >= b.pCosine + b.pInterface;
  lobe.isTransmission = s.isTransmission;
  return lobe;
}

/// The direction that the lobe draws with u, local frame.
vec3 lobeDirection(Bsdf b, vec3 wo, DrawnLobe lobe, vec2 u) {
  vec3 wi;
  if (lobe.isCosine) {
    wi = sampleCosineHemisphere(u);
  } else if (lobe.isSheen) {
    wi = sampleSheen(u);
  } else {
    const vec3 h = lobe.isCoat ? sampleCoatNormal(b.coat, wo, u) : microfacet(b, wo, u);
    wi = 2.0 * dot(wo, h) * h - wo;
    if (!lobe.isTransmission || b.isThin || !refractLocal(wo, h, b.eta, wi)) wi.z = abs(wi.z);
    else return wi;
  }
  if (lobe.isTransmission) wi.z = -wi.z;
  return wi;
}

/// Logarithm of the weight of a path through wi.
float logWeight(Bsdf b, vec3 wo, vec3 wi) {
  float pdf;
  const float f = mean(evalBsdf(b, wo, wi, pdf));
  return portableLog(max(f, 1e-20) / max(pdf, 1e-20));
}

/// Derivative by one of the numbers, from both sides.
Spread spreadAlong(Bsdf b, vec3 wo, DrawnLobe lobe, vec2 u, vec2 along) {
  const vec2 low = max(u - kNumberStep * along, vec2(0.0)), high = min(u + kNumberStep * along, vec2(0.99999));
  const vec3 from = lobeDirection(b, wo, lobe, low), to = lobeDirection(b, wo, lobe, high);
  const float scale = 1.0 / dot(high - low, along);
  return Spread(vec3(0.0), (to - from) * scale, (logWeight(b, wo, to) - logWeight(b, wo, from)) * scale);
}

void scaleSpread(inout Spread s, float scale) {
  const float limited = min(scale, kLargestSpread / max(length(s.direction), 1e-20));
  s.direction *= limited;
  s.gradient *= limited;
}

/// Steps to the neighbours among `samples` directions drawn as s was: together they cover 1/(samples · s.pdf) sr.
void sampledSpreads(Bsdf b, vec3 wo, float uLobe, vec2 u, BsdfSample s, float samples, out Spread stepU,
                    out Spread stepV) {
  const DrawnLobe lobe = drawnLobe(b, uLobe, s);
  stepU = spreadAlong(b, wo, lobe, u, vec2(1.0, 0.0));
  stepV = spreadAlong(b, wo, lobe, u, vec2(0.0, 1.0));
  const float area = length(cross(stepU.direction, stepV.direction));  // sr, of the whole unit square
  const float scale = inversesqrt(max(samples * s.pdf * area, 1e-20));
  scaleSpread(stepU, scale);
  scaleSpread(stepV, scale);
}

#endif
