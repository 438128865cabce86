// The BSDF of the lobes of lib/lobes.glsl: its value, and directions drawn from it. Cosine lobes (diffuse light, and
// light scattered more than once between microfacets) on either side; reflection and transmission, each GGX or, when
// smooth, a delta; sheen; the coat.
#ifndef IMPORTON_LIB_BSDF_GLSL
#define IMPORTON_LIB_BSDF_GLSL
#include "lib/lobes.glsl"

struct BsdfSample {
  vec3 wi;
  vec3 weight;      // f·|cos|/pdf, of all non-delta lobes together or of the delta lobe
  float pdf;        // 1/sr; 0 for a delta lobe
  bool isDelta;
  bool isTransmission;
};

/// Light that a rough clear dielectric scatters more than once, over its cosine, on the side of wi.
/// `missedIn`: share that GGX reflection misses along wi.
vec3 evalClearMissed(Bsdf b, float cosine, float missedIn) {
  const bool isBack = cosine > 0.0;
  const float missed = b.isThin ? missedIn : 1.0 - glassAlbedo(abs(cosine), b.alpha, isBack ? b.eta : 1.0 / b.eta);
  const float share = missed * b.clear * b.clearMissOut;
  if (isBack) return vec3(share * b.clearMissBack / max(b.clearMissMean.x, 1e-6));
  const vec3 passed = b.tint * (share * (1.0 - b.clearMissBack) / max(b.clearMissMean.y, 1e-6));
  return kHasSheets && b.isThin ? passed * sheetCrossed(b, kDiffuseCosine) : passed;
}

/// What takes back the scaling by the squared relative index, which light that passes diffusely does not have: paths
/// from the eye scale all that passes a solid's interface.
float diffuseScale(Bsdf b) { return b.isThin || b.isAdjoint ? 1.0 : b.eta * b.eta; }

/// Cosine lobes, times cosine: the base on the ray's side, and light scattered more than once on both. The base is
/// Lambertian under the interface, which light passes on the way in and on the way out; what the interface turns back
/// below stays until it leaves. So a white base loses nothing, and gains nothing. [Kelemen and Szirmay-Kalos 2001]
vec3 evalCosine(Bsdf b, vec3 wi) {
  if (!kHasReflection) return b.diffuse * (wi.z / kPi);
  vec2 albedo = vec2(1.0, 0.0);
  if (!b.isSmooth) albedo = microfacetAlbedo(b, abs(wi.z), azimuthOf(b, wi));
  vec3 f = vec3(0.0);
  if (wi.z > 0.0)
    f = b.diffuse * (b.coverPassed * (1.0 - coverReflectance(b, wi.z, albedo))) +
        b.missed * (b.missOut * (1.0 - albedo.x));
  else if (isTranslucent(b))
    f = b.below * (b.coverPassed * (1.0 - coverReflectance(b, -wi.z, albedo)) * diffuseScale(b));
  if (kHasTransmission && b.clear > 0.0 && !b.isSmooth) f += evalClearMissed(b, wi.z, 1.0 - albedo.x);
  return f * (abs(wi.z) / kPi);
}

/// A direction in the frame whose x axis is the tangent, and back.
vec3 alongTangent(Bsdf b, vec3 w) {
  return vec3(dot(b.tangent, w.xy), b.tangent.x * w.y - b.tangent.y * w.x, w.z);
}
vec3 fromTangent(Bsdf b, vec3 w) {
  return vec3(b.tangent.x * w.x - b.tangent.y * w.y, b.tangent.y * w.x + b.tangent.x * w.y, w.z);
}

// GGX of the surface, rough in all directions alike or not.
float distribution(Bsdf b, vec3 h) {
  return kHasAnisotropy ? ggxDistribution(alongTangent(b, h), b.alphas) : ggxDistribution(h, b.alpha);
}
float masking(Bsdf b, vec3 w) {
  return kHasAnisotropy ? ggxMasking(alongTangent(b, w), b.alphas) : ggxMasking(w, b.alpha);
}
float maskingShadowing(Bsdf b, vec3 wo, vec3 wi) {
  if (!kHasAnisotropy) return ggxMaskingShadowing(wo, wi, b.alpha);
  return ggxMaskingShadowing(alongTangent(b, wo), alongTangent(b, wi), b.alphas);
}
float pdfMicrofacet(Bsdf b, vec3 wo, vec3 h) {
  if (!kHasAnisotropy) return pdfVisibleNormal(wo, h, b.alpha);
  return pdfVisibleNormal(alongTangent(b, wo), alongTangent(b, h), b.alphas);
}
vec3 microfacet(Bsdf b, vec3 wo, vec2 u) {
  if (!kHasAnisotropy) return sampleVisibleNormal(wo, b.alpha, u);
  return fromTangent(b, sampleVisibleNormal(alongTangent(b, wo), b.alphas, u));
}

/// Microfacet reflection times cosine. [Walter et al. 2007, eq. 20]
vec3 evalReflection(Bsdf b, vec3 wo, vec3 wi, out float pdf) {
  const vec3 h = normalize(wo + wi);
  const float d = distribution(b, h);
  const float cosH = max(dot(wo, h), 0.0);
  pdf = masking(b, wo) * d * reflectShare(b, cosH) / (4.0 * wo.z);
  return bsdfFresnel(b, cosH) * (d * maskingShadowing(b, wo, wi) / (4.0 * wo.z));
}

/// Microfacet transmission times cosine, without the scaling of radiance by the squared relative index.
/// [Walter et al. 2007, eq. 16, 17 and 21]
vec3 evalTransmission(Bsdf b, vec3 wo, vec3 wi, out float pdf) {
  pdf = 0.0;
  if (b.isThin) {  // a rough sheet: the mirror image of the reflection, without bending
    const vec3 mirrored = vec3(wi.xy, -wi.z);
    const vec3 h = normalize(wo + mirrored);
    const float d = distribution(b, h);
    const float cosH = max(dot(wo, h), 0.0);
    pdf = masking(b, wo) * d * (1.0 - reflectShare(b, cosH)) / (4.0 * wo.z);
    const vec3 passed = b.clear * clearPassed(b, cosH);
    return b.tint * (passed * d * maskingShadowing(b, wo, mirrored) / (4.0 * wo.z));
  }
  vec3 h = normalize(-(wo + b.eta * wi));
  if (h.z < 0.0) h = -h;
  const float cosOut = dot(wo, h), cosIn = dot(wi, h);
  if (cosOut <= 0.0 || cosIn >= 0.0) return vec3(0.0);
  const float root = cosOut + b.eta * cosIn;
  const float jacobian = b.eta * b.eta * abs(cosIn) / max(root * root, 1e-30);
  const float d = distribution(b, h);
  pdf = pdfMicrofacet(b, wo, h) * jacobian * (1.0 - reflectShare(b, cosOut));
  const vec3 passed = b.clear * clearPassed(b, cosOut);
  return b.tint * (passed * d * maskingShadowing(b, wo, vec3(wi.xy, -wi.z)) * cosOut * jacobian / wo.z);
}

/// BSDF times |cosine| of all non-delta lobes, and the density with which sampleBsdf draws wi among them all.
vec3 evalBsdf(Bsdf b, vec3 wo, vec3 wi, out float pdf) {
  vec3 f = vec3(0.0);
  pdf = 0.0;
  if (wo.z <= 0.0) return f;
  const bool isBelow = wi.z <= 0.0;
  const bool passesRough = kHasTransmission && !b.isSmooth && b.clear > 0.0;
  if (isBelow && ((!passesRough && !isTranslucent(b)) || wi.z == 0.0)) return f;
  const float pCosine = isBelow ? b.pBelow : b.pCosine;
  if (pCosine > 0.0) {
    f = evalCosine(b, wi);
    pdf = pCosine * abs(wi.z) / kPi;
  }
  float lobePdf;
  if (kHasReflection && !b.isSmooth && (!isBelow || passesRough)) {
    f += isBelow ? evalTransmission(b, wo, wi, lobePdf) : evalReflection(b, wo, wi, lobePdf);
    pdf += b.pInterface * lobePdf;
  }
  if (hasSheen(b)) {
    f *= sheenPassed(b.sheen, abs(wi.z));
    if (!isBelow) f += evalSheen(b.sheen, wo, wi);
    if (!isBelow) pdf += b.pSheen * pdfSheen();
  }
  if (kHasClearcoat && b.coat.share > 0.0) {
    f *= coatPassed(b.coat, wi, b.isThin);
    if (!isBelow) f += evalCoatKept(b.coat, wi);
    if (!isBelow && !b.coat.isSmooth && b.pCoat > 0.0) {
      f += evalCoat(b.coat, wo, wi, lobePdf);
      pdf += b.pCoat * lobePdf;
    }
  }
  return f;
}

/// Refracts wo at normal h; eta = index behind over index in front. False at total internal reflection.
bool refractLocal(vec3 wo, vec3 h, float eta, out vec3 wi) {
  const float cosOut = dot(wo, h);
  const float sin2 = (1.0 - cosOut * cosOut) / (eta * eta);
  wi = vec3(0.0);
  if (sin2 >= 1.0) return false;
  wi = -wo / eta + (cosOut / eta - sqrt(1.0 - sin2)) * h;
  return true;
}

/// Weight of a delta lobe, chosen with `probability`.
vec3 deltaWeight(Bsdf b, vec3 wo, vec3 wi, bool isCoat, float probability) {
  if (kHasClearcoat && isCoat) return vec3(b.coat.turnedOut * coatAdjoint(b.coat, b.coat.cosOut, wo, wi) / probability);
  const vec3 f = wi.z > 0.0 ? bsdfFresnel(b, wo.z) : b.tint * (b.clear * clearPassed(b, wo.z));
  float passed = kHasClearcoat && b.coat.share > 0.0 ? coatPassed(b.coat, wi, b.isThin) : 1.0;
  if (hasSheen(b)) passed *= sheenPassed(b.sheen, abs(wi.z));
  return f * (passed / max(probability, 1e-30));
}

/// Share of light that a smooth thin surface lets straight through to where wo leads.
vec3 straightPassed(Bsdf b, vec3 wo) {
  if (!b.isSmooth || !b.isThin || b.clear <= 0.0 || wo.z <= 0.0) return vec3(0.0);
  return deltaWeight(b, wo, -wo, false, 1.0);
}

/// Draws a direction from the interface, or the coat, whichever `uLobe` falls on. The microfacet is drawn first, then
/// whether it reflects. False: nowhere.
bool sampleInterface(Bsdf b, vec3 wo, float uLobe, vec2 u, inout BsdfSample s) {
  const bool isCoat = kHasClearcoat && b.pCoat > 0.0 && uLobe >= b.pCosine + b.pInterface;
  s.isDelta = isCoat ? b.coat.isSmooth : b.isSmooth;
  vec3 h = vec3(0.0, 0.0, 1.0);
  if (isCoat) h = sampleCoatNormal(b.coat, wo, u);
  else if (!s.isDelta) h = microfacet(b, wo, u);
  const float cosH = dot(wo, h), share = isCoat ? 1.0 : reflectShare(b, cosH);
  s.isTransmission = kHasTransmission && uLobe - b.pCosine >= share * b.pInterface && share < 1.0;
  s.wi = 2.0 * cosH * h - wo;
  if (s.isTransmission) {
    if (b.isThin) s.wi.z = -s.wi.z;
    else if (!refractLocal(wo, h, b.eta, s.wi)) return false;
  }
  if (s.isDelta)
    s.weight =
        deltaWeight(b, wo, s.wi, isCoat, isCoat ? b.pCoat : b.pInterface * (s.isTransmission ? 1.0 - share : share));
  return s.isTransmission ? s.wi.z < 0.0 : s.wi.z > 0.0;
}

/// Draws a direction: uLobe chooses the lobe, u the direction. A zero weight ends the path.
BsdfSample sampleBsdf(Bsdf b, vec3 wo, float uLobe, vec2 u) {
  BsdfSample s;
  s.weight = vec3(0.0);
  s.wi = vec3(0.0, 0.0, 1.0);
  s.pdf = 0.0;
  s.isDelta = false;
  s.isTransmission = false;
  if (wo.z <= 0.0 || b.pCosine + b.pInterface + b.pBelow + b.pSheen + b.pCoat <= 0.0) return s;
  const bool isBelow = kHasTransmission && b.pBelow > 0.0 && uLobe >= 1.0 - b.pBelow;
  if (!kHasReflection || uLobe < b.pCosine || isBelow) {
    s.wi = sampleCosineHemisphere(u);
    if (isBelow) s.wi.z = -s.wi.z;
    s.isTransmission = isBelow;
  } else if (kHasSheen && uLobe >= 1.0 - b.pBelow - b.pSheen && b.pSheen > 0.0) {
    s.wi = sampleSheen(u);
  } else if (!sampleInterface(b, wo, uLobe, u, s) || s.isDelta) {
    return s;
  }
  const vec3 f = evalBsdf(b, wo, s.wi, s.pdf);
  s.weight = s.pdf > 0.0 ? f / s.pdf : vec3(0.0);
  return s;
}

#endif
