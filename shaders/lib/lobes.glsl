// The lobes that a surface scatters light by: of the glTF 2.0 metallic-roughness material, its transmission, sheen and
// clear coat, in the local frame of the shading normal (z), the ray's side up. A material is a mixture of three: metal,
// a diffuse base under a dielectric interface, and a clear dielectric. The base also lets light pass diffusely.
// [glTF 2.0, appendix B]
#ifndef IMPORTON_LIB_LOBES_GLSL
#define IMPORTON_LIB_LOBES_GLSL
#include "lib/albedo.glsl"
#include "lib/coat.glsl"
#include "lib/fresnel.glsl"
#include "lib/ggx.glsl"
#include "lib/iridescence.glsl"
#include "lib/sheen.glsl"
#include "lib/surface.glsl"
#include "shared/elementary.h"

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
  vec3 sheetDepth;    // optical thickness of a thin surface, across it
  vec3 missed;        // of light that the microfacets scatter more than once, the share that metal and interface return
  float missOut;      // share of light along wo that is scattered more than once, over the mean of all directions
  vec2 clearMissMean; // the clear dielectric: mean of that share on the ray's side and behind
  float clearMissOut;
  float clearMissBack; // of it, the share that leaves on the ray's side
  vec3 below;         // albedo of diffuse transmission times its share
  bool isAdjoint;     // photons are scattered
  vec2 alphas;        // roughness along the tangent, and across
  vec2 tangent;       // in the local frame, unit length
  float azimuthOut;   // as azimuthOf, of the direction that the BSDF was made for
  Film film;
  vec3 filmMetal;      // what metal would reflect at normal incidence without the film; the interface
  vec3 filmDielectric;
  vec2 filmShares;     // of metal, and of the base under the interface
  float filmMissed;    // as coverMissed
  Sheen sheen;
  Coat coat;
  float pCosine, pInterface, pBelow, pSheen, pCoat;  // of choosing a lobe; sum 1, or all 0 for a black surface
};

/// Share of light that crosses a sheet once, inside, where it meets it at this cosine. [Beer's law]
vec3 sheetCrossed(Bsdf b, float cosine) {
  const float inside2 = 1.0 - (1.0 - cosine * cosine) / (b.eta * b.eta);
  return portableExp(-b.sheetDepth / sqrt(max(inside2, 1e-6)));
}

const float kDiffuseCosine = 2.0 / 3.0;  // the mean cosine of diffuse light
const float kDiffuseWay = 1.66;  // of diffuse light through a layer, in thicknesses [Elsasser 1942]

/// Reflectance of the clear dielectric: Fresnel's, moved so that its values at normal and at grazing incidence are
/// those of KHR_materials_specular. Total reflection stays total. `passed`: share of light that goes on. Of thin
/// surfaces both are sums over all reflections inside, between two interfaces that reflect alike.
vec3 clearShares(Bsdf b, float cosine, out vec3 passed) {
  passed = vec3(0.0);
  const float exact = fresnelDielectric(cosine, b.eta);
  if (exact >= 1.0) return vec3(1.0);
  vec3 single = b.clearF90 * exact + b.clearShift * (1.0 - exact);
  if (kHasIridescence && b.film.share > 0.0) {
    const float cosOutside = b.eta >= 1.0 ? cosine : sqrt(1.0 - (1.0 - cosine * cosine) / (b.eta * b.eta));
    single = mix(single, filmReflectance(b.film, b.filmDielectric, cosOutside), b.film.share);
  }
  if (kHasSheets && b.isThin && maxComponent(b.sheetDepth) > 0.0) {
    const vec3 crossed = sheetCrossed(b, cosine), there = single * crossed;
    passed = (1.0 - single) * (1.0 - single) * crossed / max(1.0 - there * there, 1e-6);
    return single + passed * there;
  }
  const vec3 reflected = b.isThin ? 2.0 * single / (1.0 + single) : single;
  passed = 1.0 - reflected;
  return reflected;
}

vec3 clearFresnel(Bsdf b, float cosine) {
  vec3 passed;
  return clearShares(b, cosine, passed);
}

vec3 clearPassed(Bsdf b, float cosine) {
  vec3 passed;
  clearShares(b, cosine, passed);
  return passed;
}

bool isIridescent(Bsdf b) { return kHasIridescence && b.film.share > 0.0; }

/// Reflectance of metal and of the interface over the base, times their shares.
vec3 opaqueFresnel(Bsdf b, float cosine) {
  const vec3 bare = fresnelSchlick(b.f0, b.f90, cosine);
  if (!isIridescent(b)) return bare;
  vec3 covered = vec3(0.0);
  if (b.filmShares.x > 0.0) covered += b.filmShares.x * filmReflectance(b.film, b.filmMetal, cosine);
  if (b.filmShares.y > 0.0) covered += b.filmShares.y * filmReflectance(b.film, b.filmDielectric, cosine);
  return mix(bare, covered, b.film.share);
}

/// Reflectance of the whole interface at the cosine between a direction and the (micro)normal.
vec3 bsdfFresnel(Bsdf b, float cosine) {
  vec3 f = opaqueFresnel(b, cosine);
  if (kHasTransmission && b.clear > 0.0) f += b.clear * clearFresnel(b, cosine);
  return f;
}

/// Probability with which the interface reflects, rather than transmits, where light meets its (micro)normal at this
/// cosine.
float reflectShare(Bsdf b, float cosine) {
  if (!kHasTransmission || b.clear <= 0.0) return 1.0;
  vec3 through;
  const vec3 clear = clearShares(b, cosine, through);
  const float reflected = mean(opaqueFresnel(b, cosine) + b.clear * clear);
  const float passed = b.clear * mean(through * b.tint);
  return reflected + passed > 0.0 ? reflected / (reflected + passed) : 1.0;
}

/// Share of light along a direction that a film over the base turns back, in the channel of the most. Of rough ones
/// that at the cosine at which Schlick's reflectance is its mean over the microfacets.
float filmCover(Bsdf b, float cosine, vec2 albedo) {
  if (b.isSmooth) return maxComponent(filmReflectance(b.film, b.filmDielectric, cosine));
  const float middle = 1.0 - portablePow(clamp(albedo.y / max(albedo.x, 1e-6), 0.0, 1.0), 0.2);
  return maxComponent(filmReflectance(b.film, b.filmDielectric, middle)) * albedo.x + b.filmMissed * (1.0 - albedo.x);
}

float coverReflectance(Bsdf b, float cosine, vec2 albedo) {
  const float bare = b.isSmooth ? fresnelSchlick(vec3(b.coverF0), b.coverF90, cosine).x
                                : layerReflectance(b.coverF0, b.coverF90, b.coverMissed, albedo);
  return isIridescent(b) ? mix(bare, filmCover(b, cosine, albedo), b.film.share) : bare;
}

/// Squared cosine of the angle between the tangent and the projection of w.
float azimuthOf(Bsdf b, vec3 w) {
  const float along = dot(b.tangent, w.xy);
  return min(along * along / max(dot(w.xy, w.xy), 1e-20), 1.0);
}

/// ggxAlbedo of the surface. `azimuth`: as azimuthOf.
vec2 microfacetAlbedo(Bsdf b, float cosine, float azimuth) {
  if (kHasAnisotropy && b.alphas.x > b.alphas.y) return stretchedAlbedo(cosine, azimuth, b.alphas);
  return ggxAlbedo(cosine, b.alpha);
}

vec2 microfacetMeanAlbedo(Bsdf b) {
  if (kHasAnisotropy && b.alphas.x > b.alphas.y) return stretchedMeanAlbedo(b.alphas);
  return ggxMeanAlbedo(b.alpha);
}

/// Light that the microfacets scatter more than once, for rough surfaces. What is missed along wo leaves by the cosine
/// lobes, weighted by what is missed along wi: reciprocal, and nothing is lost. [Kulla and Conty 2017]
/// `metalMean`, `dielectricMean`: mean of reflectance over the cosine.
void addMissed(inout Bsdf b, vec3 metalMean, float metal, vec3 dielectricMean, float dielectric, vec2 albedoOut,
               float cosOut) {
  const vec2 mean_ = microfacetMeanAlbedo(b);
  b.missOut = (1.0 - albedoOut.x) / max(1.0 - mean_.x, 1e-6);
  b.missed = metal * multipleReflectance(metalMean, mean_.x) +
             dielectric * multipleReflectance(dielectricMean, mean_.x);
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
  // The table knows no film: under one nothing is given back that might not be missed.
  if (isIridescent(b) && !b.isThin) b.clearMissOut *= 1.0 - b.film.share;
  b.clearMissOut *= b.clearF90;  // what passes without reflection is masked less: this much is missed at least
}

const uint kMeanPoints = 5u;  // Gauss's quadrature over the cosine, 0 to 1
const float kMeanCosines[kMeanPoints] = float[](0.0469101, 0.2307653, 0.5, 0.7692347, 0.9530899);
const float kMeanWeights[kMeanPoints] = float[](0.1184634, 0.2393143, 0.2844444, 0.2393143, 0.1184634);

/// Mean over the cosine of a film's reflectance over a base of reflectance f0.
vec3 meanFilm(Film film, vec3 f0) {
  vec3 sum = vec3(0.0);
  for (uint i = 0u; i < kMeanPoints; ++i)
    sum += filmReflectance(film, f0, kMeanCosines[i]) * (2.0 * kMeanWeights[i] * kMeanCosines[i]);
  return sum;
}

/// Mean over the cosine of what a film over the base turns back.
float meanFilmCover(Bsdf b) {
  float sum = 0.0;
  for (uint i = 0u; i < kMeanPoints; ++i) {
    const vec2 albedo = b.isSmooth ? vec2(1.0, 0.0) : ggxAlbedo(kMeanCosines[i], b.alpha);
    sum += filmCover(b, kMeanCosines[i], albedo) * (2.0 * kMeanWeights[i] * kMeanCosines[i]);
  }
  return sum;
}

/// Probabilities of the lobes, by the light that each scatters.
void chooseLobes(inout Bsdf b, float cosOut, vec2 albedoOut) {
  b.pInterface = mean(bsdfFresnel(b, cosOut));
  b.pCosine = mean(b.diffuse) * max(b.coverPassed, 0.0);
  b.pBelow = kHasDiffuseTransmission ? mean(b.below) * max(b.coverPassed, 0.0) : 0.0;
  b.pSheen = 0.0;
  if (!b.isSmooth) {
    b.pInterface *= albedoOut.x;
    b.pCosine += mean(b.missed) * (1.0 - albedoOut.x);
  }
  if (kHasTransmission && b.clear > 0.0) {
    const float passed = b.clear * mean(b.tint);
    b.pInterface += b.clear * mean(b.tint * clearPassed(b, cosOut));
    if (!b.isSmooth) {
      b.pCosine += b.clear * b.clearMissOut * b.clearMissBack;
      b.pBelow += passed * b.clearMissOut * (1.0 - b.clearMissBack);
    }
  }
  if (kHasSheen) {
    const float passed = 1.0 - b.sheen.turnedOut;
    b.pCosine *= passed;
    b.pInterface *= passed;
    b.pBelow *= passed;
    b.pSheen = b.sheen.turnedOut * mean(b.sheen.color) / max(maxComponent(b.sheen.color), 1e-30);
  }
  if (kHasClearcoat) {
    const float passed = 1.0 - b.coat.turnedOut;
    b.pCosine *= passed;
    b.pInterface *= passed;
    b.pBelow *= passed;
    b.pSheen *= passed;
    b.pCoat = b.coat.turnedOut;
    if (b.coat.share > 0.0)
      b.pCosine += mean(b.coat.keptMetal * b.coat.takenMean.x + b.coat.keptBase * b.coat.takenMean.y);
  }
  const float sum = b.pCosine + b.pInterface + b.pBelow + b.pSheen + b.pCoat;
  const float scale = sum > 0.0 ? 1.0 / sum : 0.0;
  b.pCosine *= scale;
  b.pInterface *= scale;
  b.pBelow *= scale;
  b.pSheen *= scale;
  b.pCoat *= scale;
}

/// How rough the surface is in which direction, and where it is none of GGX's.
void makeRoughness(inout Bsdf b, Surface s) {
  b.alpha = s.alpha;
  b.isSmooth = (kHasAnisotropy ? s.alphas.x : s.alpha) < kSmoothAlpha ||
               (b.clear > 0.0 && !b.isThin && abs(b.eta - 1.0) < kNoRefraction);
  b.tangent = vec2(1.0, 0.0);
  b.azimuthOut = 0.0;
  if (!kHasAnisotropy) return;
  b.alphas = max(s.alphas, vec2(kSmoothAlpha));
  if (b.alphas.x == b.alphas.y) return;
  b.alpha = sqrt(b.alphas.x * b.alphas.y);
  const vec2 t = (s.tangent * s.frame).xy;
  if (dot(t, t) > 1e-20) b.tangent = normalize(t);
  b.azimuthOut = azimuthOf(b, s.backwards * s.frame);
}

/// A film over the surface. `metal`, `opaque`: shares.
void addFilm(inout Bsdf b, Surface s, float metal, float opaque, vec3 f0) {
  b.film = Film(0.0, 1.0, 0.0);
  if (!kHasIridescence) return;
  b.film = makeFilm(s.iridescence, s.filmIor, s.filmThickness);
  b.filmMetal = s.baseColor;
  b.filmDielectric = f0;
  b.filmShares = vec2(metal, opaque);
}

Bsdf makeBsdf(Surface s, float cosOut) {
  Bsdf b;
  const float metal = kHasReflection ? s.metallic : 0.0;
  b.clear = kHasTransmission ? (1.0 - metal) * s.transmission : 0.0;
  const float opaque = 1.0 - metal - b.clear;
  b.diffuse = s.baseColor * opaque;
  b.below = b.f0 = b.tint = vec3(0.0);
  if (kHasDiffuseTransmission) {
    b.below = s.diffuseTransmissionColor * (opaque * s.diffuseTransmission);
    b.diffuse *= 1.0 - s.diffuseTransmission;
  }
  b.isSmooth = true;
  b.isAdjoint = false;
  b.sheetDepth = vec3(0.0);
  b.coat = noCoat();
  b.sheen = noSheen();
  b.pInterface = b.pBelow = b.pSheen = b.pCoat = 0.0;
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
  if (kHasSheets && b.isThin) {
    b.sheetDepth = s.sheetDepth;
    b.below *= portableExp(-kDiffuseWay * s.sheetDepth);
  }
  makeRoughness(b, s);
  addFilm(b, s, metal, opaque, f0);
  b.missed = vec3(0.0);
  b.missOut = b.clearMissOut = b.clearMissBack = 0.0;
  vec2 albedoOut = vec2(0.0);
  float coverMean = meanSchlick(vec3(b.coverF0), b.coverF90).x;
  if (!b.isSmooth) {
    albedoOut = microfacetAlbedo(b, cosOut, b.azimuthOut);
    vec3 metalMean = meanSchlick(s.baseColor, 1.0), dielectricMean = meanSchlick(f0, b.coverF90);
    const vec2 albedo = microfacetMeanAlbedo(b);
    if (isIridescent(b)) {
      const vec3 covered = meanFilm(b.film, f0);
      b.filmMissed = multipleReflectance(vec3(maxComponent(covered)), albedo.x).x;
      metalMean = mix(metalMean, meanFilm(b.film, s.baseColor), b.film.share);
      dielectricMean = mix(dielectricMean, covered, b.film.share);
    }
    addMissed(b, metalMean, metal, dielectricMean, opaque, albedoOut, cosOut);
    b.coverMissed = multipleReflectance(vec3(coverMean), albedo.x).x;
    coverMean = layerReflectance(b.coverF0, b.coverF90, b.coverMissed, albedo);
  }
  if (isIridescent(b)) coverMean = mix(coverMean, meanFilmCover(b), b.film.share);
  b.coverPassed = (1.0 - coverReflectance(b, cosOut, albedoOut)) / max(1.0 - coverMean, 1e-3);
  if (kHasSheen && maxComponent(s.sheenColor) > 0.0) b.sheen = makeSheen(s, cosOut);
  if (kHasClearcoat && s.coat > 0.0) {
    const float base = 1.0 - maxComponent(b.sheen.color);  // sheen leaves that much at least
    b.coat = makeCoat(s, !b.isThin && !s.isFront, b.diffuse * base, metal * s.baseColor * base);
  }
  chooseLobes(b, cosOut, albedoOut);
  return b;
}

/// Photons scatter by the transposed BSDF.
void makeAdjoint(inout Bsdf b) { b.isAdjoint = b.coat.isAdjoint = true; }

bool hasSheen(Bsdf b) { return kHasSheen && maxComponent(b.sheen.color) > 0.0; }
/// True if the base lets light pass diffusely.
bool isTranslucent(Bsdf b) { return kHasDiffuseTransmission && maxComponent(b.below) > 0.0; }
bool hasSmoothLobe(Bsdf b) { return (b.isSmooth && b.pInterface > 0.0) || (b.coat.isSmooth && b.pCoat > 0.0); }
/// True for a surface that transmits and is rough. Light comes to it from both sides, which a map of photons on one
/// side cannot show, so for the maps it is specular: photons pass it as they pass clear glass.
bool isFrosted(Bsdf b) { return kHasTransmission && !b.isSmooth && b.clear > 0.0; }
/// True where the direction of light matters beyond its cosine.
bool isGlossy(Bsdf b) {
  if (isTranslucent(b) || hasSheen(b)) return true;
  const float alpha = kHasAnisotropy ? b.alphas.y : b.alpha;
  const bool isCoatGlossy = kHasClearcoat && b.pCoat > 0.0 && !b.coat.isSmooth && b.coat.alpha < 0.3;
  const bool isSharp = alpha < 0.3 || maxComponent(b.f0) > 0.2 || isIridescent(b);
  return isCoatGlossy || (kHasReflection && !b.isSmooth && isSharp);
}
bool hasRoughLobe(Bsdf b) {
  if (b.pCosine > 0.0 || (!b.isSmooth && b.pInterface > 0.0)) return true;
  if (isTranslucent(b) || hasSheen(b)) return true;
  return kHasClearcoat && b.pCoat > 0.0 && !b.coat.isSmooth;
}

/// True if some light is scattered by Lambert's law, to either side, under at most an interface.
bool hasDiffuse(Bsdf b) {
  const bool isCovered = (kHasClearcoat && b.coat.share > 0.0) || hasSheen(b);
  return (maxComponent(b.diffuse) > 0.0 || isTranslucent(b)) && !isCovered;
}

/// The diffuse base in two factors: towards wo, from the same side or from behind, and from wi.
vec3 diffuseTowards(Bsdf b) { return kHasReflection ? b.diffuse * max(b.coverPassed, 0.0) : b.diffuse; }

vec3 diffuseFromBehind(Bsdf b) { return b.below * max(b.coverPassed, 0.0); }

/// Of the direction that the BSDF was made for; `cosIn`: its cosine.
float diffuseFrom(Bsdf b, float cosIn) {
  if (!kHasReflection) return 1.0;
  return 1.0 - coverReflectance(b, cosIn, b.isSmooth ? vec2(0.0) : microfacetAlbedo(b, cosIn, b.azimuthOut));
}

/// Takes the diffuse base away. `left`: about how much light the other lobes scatter, 0 to 1.
void removeDiffuse(inout Bsdf b, float cosOut, out float left) {
  b.diffuse = b.below = vec3(0.0);
  const vec2 albedoOut = b.isSmooth ? vec2(1.0, 0.0) : microfacetAlbedo(b, cosOut, b.azimuthOut);
  left = kHasReflection
             ? mean(bsdfFresnel(b, cosOut)) * albedoOut.x + (b.isSmooth ? 0.0 : mean(b.missed) * (1.0 - albedoOut.x))
             : 0.0;
  if (kHasTransmission && b.clear > 0.0) left = 1.0;
  if (left > 0.0) chooseLobes(b, cosOut, albedoOut);
}

#endif
