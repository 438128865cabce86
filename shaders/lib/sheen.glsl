// KHR_materials_sheen: fibres over the base that reflect at grazing angles. The base keeps what they leave on the way
// in or out, whichever is less. Where the lobe of sharp sheen would reflect more than comes in it is bounded, in both
// directions alike.
#ifndef IMPORTON_LIB_SHEEN_GLSL
#define IMPORTON_LIB_SHEEN_GLSL
#include "lib/albedo.glsl"
#include "lib/sampling.glsl"
#include "lib/surface.glsl"
#include "shared/elementary.h"

struct Sheen {
  vec3 color;      // 0: none
  float alpha;
  float cosOut;    // of the direction that the BSDF was made for
  float boundOut;  // on the value there
  float turnedOut; // share of light along it that the base does not get
};

Sheen noSheen() { return Sheen(vec3(0.0), 1.0, 1.0, 1.0, 0.0); }

Sheen makeSheen(Surface s, float cosOut) {
  const vec2 albedo = sheenAlbedo(cosOut, s.sheenAlpha);
  return Sheen(s.sheenColor, max(s.sheenAlpha, kLeastSheenAlpha), cosOut, albedo.y,
               maxComponent(s.sheenColor) * albedo.x);
}

/// Share of light between the two directions that the base gets.
float sheenPassed(Sheen s, float cosIn) {
  return 1.0 - max(s.turnedOut, maxComponent(s.color) * sheenAlbedo(cosIn, s.alpha).x);
}

/// Fit of the logarithm of Smith's Λ. [Estevez and Kulla 2017, table 1]
float sheenFit(float x, float alpha) {
  const float t = (1.0 - alpha) * (1.0 - alpha);
  const float a = mix(25.3245, 21.5473, t), b = mix(3.32435, 3.82987, t), c = mix(0.16801, 0.19823, t);
  const float d = mix(-1.27393, -1.97760, t), e = mix(-4.85967, -4.32054, t);
  return a / (1.0 + b * portablePow(x, c)) + d * x + e;
}

/// [Estevez and Kulla 2017, eq. 3]
float sheenLambda(float cosine, float alpha) {
  return portableExp(cosine < 0.5 ? sheenFit(cosine, alpha)
                                  : 2.0 * sheenFit(0.5, alpha) - sheenFit(1.0 - cosine, alpha));
}

/// Reflection, times cosine. Charlie's distribution: [Estevez and Kulla 2017, eq. 2]
vec3 evalSheen(Sheen s, vec3 wo, vec3 wi) {
  const vec3 h = wo + wi;
  const float sin2 = clamp(dot(h.xy, h.xy) / max(dot(h, h), 1e-30), 0.0, 1.0), sharp = 1.0 / s.alpha;
  const float d = (2.0 + sharp) * portablePow(sin2, 0.5 * sharp) / (2.0 * kPi);
  const float masked = 1.0 / (1.0 + sheenLambda(wo.z, s.alpha) + sheenLambda(wi.z, s.alpha));
  const float bound = min(s.boundOut, sheenAlbedo(wi.z, s.alpha).y);
  return s.color * (bound * d * masked / (4.0 * wo.z));
}

/// Uniform over the hemisphere: the lobe favours directions that a cosine would leave out.
vec3 sampleSheen(vec2 u) { return sampleCone(u, 0.0); }
float pdfSheen() { return 1.0 / (2.0 * kPi); }

#endif
