// The glTF 2.0 metallic-roughness BSDF with transmission, in the local frame of the shading normal (z), the ray's
// side up. Lobes: diffuse; reflection and transmission, each GGX or, when smooth, a delta. [glTF 2.0, appendix B]
#ifndef IMPORTON_LIB_BSDF_GLSL
#define IMPORTON_LIB_BSDF_GLSL
#include "lib/fresnel.glsl"
#include "lib/ggx.glsl"
#include "lib/surface.glsl"

const float kSmoothAlpha = 1e-3;  // below: reflection and transmission are deltas

struct Bsdf {
  vec3 diffuse;       // albedo
  vec3 f0;
  float f90;
  float alpha;
  bool isSmooth;
  float metallic;
  float transmission; // share of the dielectric's base that transmits
  vec3 tint;          // of transmitted light
  float eta;          // refractive index behind over index in front, seen from the ray's side
  bool isThin;        // transmission goes straight on
  float pDiffuse, pReflect, pTransmit;  // of choosing a lobe; sum 1, or all 0 for a black surface
};

struct BsdfSample {
  vec3 wi;
  vec3 weight;      // f·|cos|/pdf, of all non-delta lobes together or of the delta lobe
  float pdf;        // 1/sr; 0 for a delta lobe
  bool isDelta;
  bool isTransmission;
};

/// Reflectance of the whole interface at the cosine between a direction and the (micro)normal.
vec3 bsdfFresnel(Bsdf b, float cosine) {
  const vec3 opaque = fresnelSchlick(b.f0, b.f90, cosine);
  if (!kHasTransmission || b.transmission <= 0.0) return opaque;
  const float single = fresnelDielectric(cosine, b.eta);
  const float clear = b.isThin ? 2.0 * single / (1.0 + single) : single;  // thin: all inner reflections
  return mix(opaque, vec3(clear), b.transmission * (1.0 - b.metallic));
}

Bsdf makeBsdf(Surface s, float cosOut) {
  Bsdf b;
  b.diffuse = s.baseColor * ((1.0 - s.metallic) * (1.0 - (kHasTransmission ? s.transmission : 0.0)));
  b.pReflect = 0.0;
  b.pTransmit = 0.0;
  b.transmission = 0.0;
  b.isSmooth = true;
  if (kHasReflection) {
    b.f0 = s.f0;
    b.f90 = s.f90;
    b.alpha = s.alpha;
    b.isSmooth = s.alpha < kSmoothAlpha;
    b.metallic = s.metallic;
    b.transmission = kHasTransmission ? s.transmission : 0.0;
    b.tint = s.baseColor;
    b.isThin = (s.flags & kMaterialSolid) == 0u;
    b.eta = s.isFront || b.isThin ? s.ior : 1.0 / s.ior;
    b.pReflect = mean(bsdfFresnel(b, cosOut));
    if (kHasTransmission) b.pTransmit = (1.0 - b.pReflect) * b.transmission * (1.0 - s.metallic) * mean(b.tint);
  }
  b.pDiffuse = mean(b.diffuse) * (1.0 - min(b.pReflect, 1.0));
  const float sum = b.pDiffuse + b.pReflect + b.pTransmit;
  const float scale = sum > 0.0 ? 1.0 / sum : 0.0;
  b.pDiffuse *= scale;
  b.pReflect *= scale;
  b.pTransmit *= scale;
  return b;
}

/// Probability that a sampled lobe is a delta.
float deltaProbability(Bsdf b) { return b.isSmooth ? b.pReflect + b.pTransmit : 0.0; }
bool hasSmoothLobe(Bsdf b) { return b.isSmooth && b.pReflect + b.pTransmit > 0.0; }
/// True for a surface that transmits and is rough. Light comes to it from both sides, which a map of photons on one
/// side cannot show, so for the maps it is specular: photons pass it as they pass clear glass.
bool isFrosted(Bsdf b) { return kHasTransmission && !b.isSmooth && b.transmission * (1.0 - b.metallic) > 0.0; }
/// True where the direction of light matters beyond its cosine.
bool isGlossy(Bsdf b) { return kHasReflection && !b.isSmooth && (b.alpha < 0.3 || maxComponent(b.f0) > 0.2); }
bool hasRoughLobe(Bsdf b) { return b.pDiffuse > 0.0 || (!b.isSmooth && b.pReflect + b.pTransmit > 0.0); }

/// Diffuse part times cosine: Lambert under the dielectric's interface. Light passes it on the way in and on the way
/// out; what it turns back below stays until it leaves. So a white base loses nothing, which a cover by the Fresnel
/// term of the half vector would not hold: it gains up to 80 % at grazing angles. [Kelemen and Szirmay-Kalos 2001]
vec3 evalDiffuse(Bsdf b, vec3 wo, vec3 wi) {
  if (!kHasReflection) return b.diffuse * (wi.z / kPi);
  const float f0 = min(maxComponent(b.f0), 1.0);
  const float passed = 1.0 - (f0 + (b.f90 - f0) / 21.0);  // mean of 1 - F over the cosine
  const float in_ = 1.0 - fresnelSchlick(vec3(f0), b.f90, wi.z).x, out_ = 1.0 - fresnelSchlick(vec3(f0), b.f90, wo.z).x;
  return b.diffuse * (in_ * out_ / max(passed, 1e-3) * wi.z / kPi);
}

/// Microfacet reflection times cosine. [Walter et al. 2007, eq. 20]
vec3 evalReflection(Bsdf b, vec3 wo, vec3 wi, out float pdf) {
  const vec3 h = normalize(wo + wi);
  const float d = ggxDistribution(h, b.alpha);
  pdf = ggxMasking(wo, b.alpha) * d / (4.0 * wo.z);
  return bsdfFresnel(b, max(dot(wo, h), 0.0)) * (d * ggxMaskingShadowing(wo, wi, b.alpha) / (4.0 * wo.z));
}

/// Microfacet transmission times cosine, without the scaling of radiance by the squared relative index.
/// [Walter et al. 2007, eq. 16, 17 and 21]
vec3 evalTransmission(Bsdf b, vec3 wo, vec3 wi, out float pdf) {
  pdf = 0.0;
  if (b.isThin) {  // a rough sheet: the mirror image of the reflection, without bending
    const vec3 mirrored = vec3(wi.xy, -wi.z);
    const vec3 h = normalize(wo + mirrored);
    const float d = ggxDistribution(h, b.alpha);
    pdf = ggxMasking(wo, b.alpha) * d / (4.0 * wo.z);
    const float passed = b.transmission * (1.0 - b.metallic);
    return b.tint * (vec3(passed) * (1.0 - mean(bsdfFresnel(b, max(dot(wo, h), 0.0)))) *
                     (d * ggxMaskingShadowing(wo, mirrored, b.alpha) / (4.0 * wo.z)));
  }
  vec3 h = normalize(-(wo + b.eta * wi));
  if (h.z < 0.0) h = -h;
  const float cosOut = dot(wo, h), cosIn = dot(wi, h);
  if (cosOut <= 0.0 || cosIn >= 0.0) return vec3(0.0);
  const float root = cosOut + b.eta * cosIn;
  const float jacobian = b.eta * b.eta * abs(cosIn) / max(root * root, 1e-30);
  const float d = ggxDistribution(h, b.alpha);
  pdf = pdfVisibleNormal(wo, h, b.alpha) * jacobian;
  const float passed = b.transmission * (1.0 - b.metallic) * (1.0 - fresnelDielectric(cosOut, b.eta));
  return b.tint * (passed * d * ggxMaskingShadowing(wo, vec3(wi.xy, -wi.z), b.alpha) * cosOut * jacobian / wo.z);
}

/// BSDF times |cosine| of all non-delta lobes, and the density with which sampleBsdf draws wi among them all.
vec3 evalBsdf(Bsdf b, vec3 wo, vec3 wi, out float pdf) {
  vec3 f = vec3(0.0);
  pdf = 0.0;
  if (wo.z <= 0.0) return f;
  if (wi.z > 0.0) {
    if (b.pDiffuse > 0.0) {
      f = evalDiffuse(b, wo, wi);
      pdf = b.pDiffuse * wi.z / kPi;
    }
    if (kHasReflection && !b.isSmooth) {
      float lobePdf;
      f += evalReflection(b, wo, wi, lobePdf);
      pdf += b.pReflect * lobePdf;
    }
  } else if (kHasTransmission && !b.isSmooth && b.pTransmit > 0.0 && wi.z < 0.0) {
    float lobePdf;
    f = evalTransmission(b, wo, wi, lobePdf);
    pdf = b.pTransmit * lobePdf;
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

/// Draws a direction: uLobe chooses the lobe, u the direction. A zero weight ends the path.
BsdfSample sampleBsdf(Bsdf b, vec3 wo, float uLobe, vec2 u) {
  BsdfSample s;
  s.weight = vec3(0.0);
  s.wi = vec3(0.0, 0.0, 1.0);
  s.pdf = 0.0;
  s.isDelta = false;
  s.isTransmission = false;
  if (wo.z <= 0.0 || b.pDiffuse + b.pReflect + b.pTransmit <= 0.0) return s;
  if (!kHasReflection || uLobe < b.pDiffuse) {
    s.wi = sampleCosineHemisphere(u);
  } else {
    const bool transmits = kHasTransmission && uLobe >= b.pDiffuse + b.pReflect;
    s.isTransmission = transmits;
    const vec3 h = b.isSmooth ? vec3(0.0, 0.0, 1.0) : sampleVisibleNormal(wo, b.alpha, u);
    s.wi = 2.0 * dot(wo, h) * h - wo;
    if (transmits) {
      if (b.isThin) s.wi.z = -s.wi.z;
      else if (!refractLocal(wo, h, b.eta, s.wi)) return s;
    }
    if (b.isSmooth) {
      const vec3 fresnel = bsdfFresnel(b, wo.z);
      s.isDelta = true;
      if (!transmits) s.weight = fresnel / b.pReflect;
      else s.weight = b.tint * (b.transmission * (1.0 - b.metallic) * (1.0 - mean(fresnel)) / b.pTransmit);
      return s;
    }
    if (transmits ? s.wi.z >= 0.0 : s.wi.z <= 0.0) return s;
  }
  const vec3 f = evalBsdf(b, wo, s.wi, s.pdf);
  s.weight = s.pdf > 0.0 ? f / s.pdf : vec3(0.0);
  return s;
}

#endif
