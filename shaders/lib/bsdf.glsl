// The glTF 2.0 metallic-roughness BSDF with transmission and clear coat, in the local frame of the shading normal
// (z), the ray's side up. A material is a mixture of three: metal, a diffuse base under a dielectric interface, and a
// clear dielectric. Lobes: cosine (diffuse light, and light scattered more than once between microfacets), on either
// side; reflection and transmission, each GGX or, when smooth, a delta; the coat. [glTF 2.0, appendix B]
#ifndef IMPORTON_LIB_BSDF_GLSL
#define IMPORTON_LIB_BSDF_GLSL
#include "lib/albedo.glsl"
#include "lib/coat.glsl"
#include "lib/fresnel.glsl"
#include "lib/ggx.glsl"
#include "lib/surface.glsl"

const float kNoRefraction = 1e-3;  // relative index of a solid so near to 1 bends no light

struct Bsdf {
  vec3 diffuse;       // albedo of the base times its share
  float coverF0;      // interface over the base
  float coverF90;
  float coverMissed;  // of light that the interface scatters more than once, the share that it turns back
  float coverPassed;  // share of light along wo that passes it, over the mean of all directions
  vec3 f0;            // of metal and interface, times their shares
  float f90;
  float alpha;
  bool isSmooth;
  float clear;        // share of the clear dielectric
  float clearF90;     // KHR_materials_specular
  vec3 clearShift;    // see clearFresnel
  vec3 tint;          // of transmitted light
  float eta;          // refractive index behind over index in front, seen from the ray's side
  bool isThin;        // transmission goes straight on
  vec3 missed;        // of light that the microfacets scatter more than once, the share that metal and interface return
  float missOut;      // share of light along wo that is scattered more than once, over the mean of all directions
  vec2 clearMissMean; // the clear dielectric: mean of that share on the ray's side and behind
  float clearMissOut;
  float clearMissBack; // of it, the share that leaves on the ray's side
  Coat coat;
  float pCosine, pInterface, pBelow, pCoat;  // of choosing a lobe; sum 1, or all 0 for a black surface
};

struct BsdfSample {
  vec3 wi;
  vec3 weight;      // f·|cos|/pdf, of all non-delta lobes together or of the delta lobe
  float pdf;        // 1/sr; 0 for a delta lobe
  bool isDelta;
  bool isTransmission;
};

/// Reflectance of the clear dielectric: Fresnel's, moved so that its values at normal and at grazing incidence are
/// those of KHR_materials_specular. Total reflection stays total.
vec3 clearFresnel(Bsdf b, float cosine) {
  const float exact = fresnelDielectric(cosine, b.eta);
  if (exact >= 1.0) return vec3(1.0);
  const vec3 single = b.clearF90 * exact + b.clearShift * (1.0 - exact);
  return b.isThin ? 2.0 * single / (1.0 + single) : single;  // thin: all inner reflections
}

/// Reflectance of the whole interface at the cosine between a direction and the (micro)normal.
vec3 bsdfFresnel(Bsdf b, float cosine) {
  vec3 f = fresnelSchlick(b.f0, b.f90, cosine);
  if (kHasTransmission && b.clear > 0.0) f += b.clear * clearFresnel(b, cosine);
  return f;
}

/// Probability with which the interface reflects, rather than transmits, where light meets its (micro)normal at this
/// cosine.
float reflectShare(Bsdf b, float cosine) {
  if (!kHasTransmission || b.clear <= 0.0) return 1.0;
  const vec3 clear = clearFresnel(b, cosine);
  const float reflected = mean(fresnelSchlick(b.f0, b.f90, cosine) + b.clear * clear);
  const float passed = b.clear * mean((1.0 - clear) * b.tint);
  return reflected + passed > 0.0 ? reflected / (reflected + passed) : 1.0;
}

float coverReflectance(Bsdf b, float cosine, vec2 albedo) {
  if (b.isSmooth) return fresnelSchlick(vec3(b.coverF0), b.coverF90, cosine).x;
  return layerReflectance(b.coverF0, b.coverF90, b.coverMissed, albedo);
}

/// Light that the microfacets scatter more than once, for rough surfaces. What is missed along wo leaves by the cosine
/// lobes, weighted by what is missed along wi: reciprocal, and nothing is lost. [Kulla and Conty 2017]
void addMissed(inout Bsdf b, vec3 metalF0, float metal, vec3 dielectricF0, float dielectric, vec2 albedoOut,
               float cosOut) {
  const vec2 mean_ = ggxMeanAlbedo(b.alpha);
  b.missOut = (1.0 - albedoOut.x) / max(1.0 - mean_.x, 1e-6);
  b.missed = metal * multipleReflectance(meanSchlick(metalF0, 1.0), mean_.x) +
             dielectric * multipleReflectance(meanSchlick(dielectricF0, b.coverF90), mean_.x);
  if (!kHasTransmission || b.clear <= 0.0) return;
  if (b.isThin) {
    const float single = (b.eta - 1.0) / (4.08567 + 1.00071 * b.eta);  // mean Fresnel reflectance [ibid.]
    b.clearMissMean = vec2(1.0 - mean_.x);
    b.clearMissOut = 1.0 - albedoOut.x;
    b.clearMissBack = 2.0 * single / (1.0 + single);
  } else {
    // Shares in the ratio that makes the two sides reciprocal.
    b.clearMissMean = vec2(1.0) - glassMeanAlbedo(b.alpha, b.eta);
    b.clearMissOut = 1.0 - glassAlbedo(cosOut, b.alpha, b.eta);
    const float behind = b.eta * b.eta * b.clearMissMean.y;
    b.clearMissBack = b.clearMissMean.x / max(b.clearMissMean.x + behind, 1e-9);
  }
  b.clearMissOut *= b.clearF90;  // what passes without reflection is masked less: this much is missed at least
}

/// Probabilities of the lobes, by the light that each scatters.
void chooseLobes(inout Bsdf b, float cosOut, vec2 albedoOut) {
  b.pInterface = mean(bsdfFresnel(b, cosOut));
  b.pCosine = mean(b.diffuse) * max(b.coverPassed, 0.0);
  if (!b.isSmooth) {
    b.pInterface *= albedoOut.x;
    b.pCosine += mean(b.missed) * (1.0 - albedoOut.x);
  }
  if (kHasTransmission && b.clear > 0.0) {
    const float passed = b.clear * mean(b.tint);
    b.pInterface += b.clear * mean(b.tint * (1.0 - clearFresnel(b, cosOut)));
    if (!b.isSmooth) {
      b.pCosine += b.clear * b.clearMissOut * b.clearMissBack;
      b.pBelow = passed * b.clearMissOut * (1.0 - b.clearMissBack);
    }
  }
  if (kHasClearcoat) {
    const float passed = 1.0 - b.coat.turnedOut;
    b.pCosine *= passed;
    b.pInterface *= passed;
    b.pBelow *= passed;
    b.pCoat = b.coat.turnedOut;
    if (b.coat.share > 0.0)
      b.pCosine += mean(b.coat.keptMetal * b.coat.takenMean.x + b.coat.keptBase * b.coat.takenMean.y);
  }
  const float sum = b.pCosine + b.pInterface + b.pBelow + b.pCoat;
  const float scale = sum > 0.0 ? 1.0 / sum : 0.0;
  b.pCosine *= scale;
  b.pInterface *= scale;
  b.pBelow *= scale;
  b.pCoat *= scale;
}

Bsdf makeBsdf(Surface s, float cosOut) {
  Bsdf b;
  const float metal = kHasReflection ? s.metallic : 0.0;
  b.clear = kHasTransmission ? (1.0 - metal) * s.transmission : 0.0;
  const float opaque = 1.0 - metal - b.clear;
  b.diffuse = s.baseColor * opaque;
  b.isSmooth = true;
  b.coat = noCoat();
  b.pInterface = b.pBelow = b.pCoat = 0.0;
  b.pCosine = mean(b.diffuse) > 0.0 ? 1.0 : 0.0;
  if (!kHasReflection) return b;
  const float ratio = (s.ior - 1.0) / (s.ior + 1.0), exactF0 = ratio * ratio;
  const vec3 f0 = min(exactF0 * s.specularColor, vec3(1.0)) * s.specular;
  b.coverF0 = maxComponent(f0);
  b.coverF90 = s.specular;
  b.f0 = metal * s.baseColor + opaque * f0;
  b.f90 = metal + opaque * s.specular;
  b.clearF90 = s.specular;
  b.clearShift = (f0 - s.specular * exactF0) / max(1.0 - exactF0, 1e-6);
  b.tint = s.baseColor;
  b.isThin = (s.flags & kMaterialSolid) == 0u;
  b.eta = s.isFront || b.isThin ? s.ior : 1.0 / s.ior;
  b.alpha = s.alpha;
  b.isSmooth = s.alpha < kSmoothAlpha || (b.clear > 0.0 && !b.isThin && abs(b.eta - 1.0) < kNoRefraction);
  b.missed = vec3(0.0);
  b.missOut = b.clearMissOut = b.clearMissBack = 0.0;
  vec2 albedoOut = vec2(0.0);
  float coverMean = meanSchlick(vec3(b.coverF0), b.coverF90).x;
  if (!b.isSmooth) {
    albedoOut = ggxAlbedo(cosOut, b.alpha);
    addMissed(b, s.baseColor, metal, f0, opaque, albedoOut, cosOut);
    const vec2 albedo = ggxMeanAlbedo(b.alpha);
    b.coverMissed = multipleReflectance(vec3(coverMean), albedo.x).x;
    coverMean = layerReflectance(b.coverF0, b.coverF90, b.coverMissed, albedo);
  }
  b.coverPassed = (1.0 - coverReflectance(b, cosOut, albedoOut)) / max(1.0 - coverMean, 1e-3);
  if (kHasClearcoat && s.coat > 0.0) b.coat = makeCoat(s, !b.isThin && !s.isFront, b.diffuse, metal * s.baseColor);
  chooseLobes(b, cosOut, albedoOut);
  return b;
}

bool hasSmoothLobe(Bsdf b) { return (b.isSmooth && b.pInterface > 0.0) || (b.coat.isSmooth && b.pCoat > 0.0); }
/// True for a surface that transmits and is rough. Light comes to it from both sides, which a map of photons on one
/// side cannot show, so for the maps it is specular: photons pass it as they pass clear glass.
bool isFrosted(Bsdf b) { return kHasTransmission && !b.isSmooth && b.clear > 0.0; }
/// True where the direction of light matters beyond its cosine.
bool isGlossy(Bsdf b) {
  const bool isCoatGlossy = kHasClearcoat && b.pCoat > 0.0 && !b.coat.isSmooth && b.coat.alpha < 0.3;
  return isCoatGlossy || (kHasReflection && !b.isSmooth && (b.alpha < 0.3 || maxComponent(b.f0) > 0.2));
}
bool hasRoughLobe(Bsdf b) {
  if (b.pCosine > 0.0 || (!b.isSmooth && b.pInterface > 0.0)) return true;
  return kHasClearcoat && b.pCoat > 0.0 && !b.coat.isSmooth;
}

/// True if some light is scattered by Lambert's law, under at most an interface.
bool hasDiffuse(Bsdf b) { return maxComponent(b.diffuse) > 0.0 && !(kHasClearcoat && b.coat.share > 0.0); }

/// The diffuse base in two factors: towards wo, and from wi on the same side.
vec3 diffuseTowards(Bsdf b) { return kHasReflection ? b.diffuse * max(b.coverPassed, 0.0) : b.diffuse; }

float diffuseFrom(Bsdf b, float cosIn) {
  if (!kHasReflection) return 1.0;
  return 1.0 - coverReflectance(b, cosIn, b.isSmooth ? vec2(0.0) : ggxAlbedo(cosIn, b.alpha));
}

/// Takes the diffuse base away. `left`: about how much light the other lobes scatter, 0 to 1.
void removeDiffuse(inout Bsdf b, float cosOut, out float left) {
  b.diffuse = vec3(0.0);
  const vec2 albedoOut = b.isSmooth ? vec2(1.0, 0.0) : ggxAlbedo(cosOut, b.alpha);
  left = kHasReflection
             ? mean(bsdfFresnel(b, cosOut)) * albedoOut.x + (b.isSmooth ? 0.0 : mean(b.missed) * (1.0 - albedoOut.x))
             : 0.0;
  if (kHasTransmission && b.clear > 0.0) left = 1.0;
  if (left > 0.0) chooseLobes(b, cosOut, albedoOut);
}

/// Light that a rough clear dielectric scatters more than once, over its cosine, on the side of wi.
/// `missedIn`: share that GGX reflection misses along wi.
vec3 evalClearMissed(Bsdf b, float cosine, float missedIn) {
  const bool isBack = cosine > 0.0;
  const float missed = b.isThin ? missedIn : 1.0 - glassAlbedo(abs(cosine), b.alpha, isBack ? b.eta : 1.0 / b.eta);
  const float share = missed * b.clear * b.clearMissOut;
  return isBack ? vec3(share * b.clearMissBack / max(b.clearMissMean.x, 1e-6))
                : b.tint * (share * (1.0 - b.clearMissBack) / max(b.clearMissMean.y, 1e-6));
}

/// Cosine lobes, times cosine: the base on the ray's side, and light scattered more than once on both. The base is
/// Lambertian under the interface, which light passes on the way in and on the way out; what the interface turns back
/// below stays until it leaves. So a white base loses nothing, and gains nothing. [Kelemen and Szirmay-Kalos 2001]
vec3 evalCosine(Bsdf b, vec3 wi) {
  if (!kHasReflection) return b.diffuse * (wi.z / kPi);
  vec2 albedo = vec2(1.0, 0.0);
  if (!b.isSmooth) albedo = ggxAlbedo(abs(wi.z), b.alpha);
  vec3 f = vec3(0.0);
  if (wi.z > 0.0)
    f = b.diffuse * (b.coverPassed * (1.0 - coverReflectance(b, wi.z, albedo))) +
        b.missed * (b.missOut * (1.0 - albedo.x));
  if (kHasTransmission && b.clear > 0.0 && !b.isSmooth) f += evalClearMissed(b, wi.z, 1.0 - albedo.x);
  return f * (abs(wi.z) / kPi);
}

/// Microfacet reflection times cosine. [Walter et al. 2007, eq. 20]
vec3 evalReflection(Bsdf b, vec3 wo, vec3 wi, out float pdf) {
  const vec3 h = normalize(wo + wi);
  const float d = ggxDistribution(h, b.alpha);
  const float cosH = max(dot(wo, h), 0.0);
  pdf = ggxMasking(wo, b.alpha) * d * reflectShare(b, cosH) / (4.0 * wo.z);
  return bsdfFresnel(b, cosH) * (d * ggxMaskingShadowing(wo, wi, b.alpha) / (4.0 * wo.z));
}

/// Microfacet transmission times cosine, without the scaling of radiance by the squared relative index.
/// [Walter et al. 2007, eq. 16, 17 and 21]
vec3 evalTransmission(Bsdf b, vec3 wo, vec3 wi, out float pdf) {
  pdf = 0.0;
  if (b.isThin) {  // a rough sheet: the mirror image of the reflection, without bending
    const vec3 mirrored = vec3(wi.xy, -wi.z);
    const vec3 h = normalize(wo + mirrored);
    const float d = ggxDistribution(h, b.alpha);
    const float cosH = max(dot(wo, h), 0.0);
    pdf = ggxMasking(wo, b.alpha) * d * (1.0 - reflectShare(b, cosH)) / (4.0 * wo.z);
    const vec3 passed = b.clear * (1.0 - clearFresnel(b, cosH));
    return b.tint * (passed * d * ggxMaskingShadowing(wo, mirrored, b.alpha) / (4.0 * wo.z));
  }
  vec3 h = normalize(-(wo + b.eta * wi));
  if (h.z < 0.0) h = -h;
  const float cosOut = dot(wo, h), cosIn = dot(wi, h);
  if (cosOut <= 0.0 || cosIn >= 0.0) return vec3(0.0);
  const float root = cosOut + b.eta * cosIn;
  const float jacobian = b.eta * b.eta * abs(cosIn) / max(root * root, 1e-30);
  const float d = ggxDistribution(h, b.alpha);
  pdf = pdfVisibleNormal(wo, h, b.alpha) * jacobian * (1.0 - reflectShare(b, cosOut));
  const vec3 passed = b.clear * (1.0 - clearFresnel(b, cosOut));
  return b.tint * (passed * d * ggxMaskingShadowing(wo, vec3(wi.xy, -wi.z), b.alpha) * cosOut * jacobian / wo.z);
}

/// BSDF times |cosine| of all non-delta lobes, and the density with which sampleBsdf draws wi among them all.
vec3 evalBsdf(Bsdf b, vec3 wo, vec3 wi, out float pdf) {
  vec3 f = vec3(0.0);
  pdf = 0.0;
  if (wo.z <= 0.0) return f;
  const bool isBelow = wi.z <= 0.0;
  if (isBelow && (!kHasTransmission || b.isSmooth || b.clear <= 0.0 || wi.z == 0.0)) return f;
  const float pCosine = isBelow ? b.pBelow : b.pCosine;
  if (pCosine > 0.0) {
    f = evalCosine(b, wi);
    pdf = pCosine * abs(wi.z) / kPi;
  }
  float lobePdf;
  if (kHasReflection && !b.isSmooth) {
    f += isBelow ? evalTransmission(b, wo, wi, lobePdf) : evalReflection(b, wo, wi, lobePdf);
    pdf += b.pInterface * lobePdf;
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
  const vec3 f = wi.z > 0.0 ? bsdfFresnel(b, wo.z) : b.tint * (b.clear * (1.0 - clearFresnel(b, wo.z)));
  const float passed = kHasClearcoat && b.coat.share > 0.0 ? coatPassed(b.coat, wi, b.isThin) : 1.0;
  return f * (passed / max(probability, 1e-30));
}

/// Draws a direction from the interface, or the coat, whichever `uLobe` falls on. The microfacet is drawn first, then
/// whether it reflects. False: nowhere.
bool sampleInterface(Bsdf b, vec3 wo, float uLobe, vec2 u, inout BsdfSample s) {
  const bool isCoat = kHasClearcoat && b.pCoat > 0.0 && uLobe >= b.pCosine + b.pInterface;
  s.isDelta = isCoat ? b.coat.isSmooth : b.isSmooth;
  vec3 h = vec3(0.0, 0.0, 1.0);
  if (isCoat) h = sampleCoatNormal(b.coat, wo, u);
  else if (!s.isDelta) h = sampleVisibleNormal(wo, b.alpha, u);
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
  if (wo.z <= 0.0 || b.pCosine + b.pInterface + b.pBelow + b.pCoat <= 0.0) return s;
  const bool isBelow = kHasTransmission && b.pBelow > 0.0 && uLobe >= 1.0 - b.pBelow;
  if (!kHasReflection || uLobe < b.pCosine || isBelow) {
    s.wi = sampleCosineHemisphere(u);
    if (isBelow) s.wi.z = -s.wi.z;
    s.isTransmission = isBelow;
  } else if (!sampleInterface(b, wo, uLobe, u, s) || s.isDelta) {
    return s;
  }
  const vec3 f = evalBsdf(b, wo, s.wi, s.pdf);
  s.weight = s.pdf > 0.0 ? f / s.pdf : vec3(0.0);
  return s;
}

#endif
