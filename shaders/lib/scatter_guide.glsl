// A guide for scattering: in each cell of a ScatterGrid a histogram of directions, over the unit square that
// sampleCosineHemisphere takes. A photon scatters by a mixture of it and of the BSDF, weighted by the density of both
// together. [Peter and Pietrek 1998; Veach 1997, section 9.2, for the mixture]
// The kernel defines `float scatterGuide(uint index)` before including this file: of each cell the share of light from
// cosine lobes that is guided, then the histogram summed up, from its first bin to 1.
#ifndef IMPORTON_LIB_SCATTER_GUIDE_GLSL
#define IMPORTON_LIB_SCATTER_GUIDE_GLSL
#include "lib/bsdf.glsl"
#include "lib/scatter_grid.glsl"

/// A mixture of BSDF and guide.
struct GuidedScatter {
  uint first;   // of the cell in the guide
  float share;  // of samples that follow the guide
};

GuidedScatter scatterGuideAt(ScatterGrid grid, Bsdf b, vec3 position, vec3 normal) {
  const uint first = scatterCell(grid, position, normal) * (kScatterBins * kScatterBins + 1u);
  return GuidedScatter(first, scatterGuide(first) * b.pCosine);
}

float binStart(uint first, uint bin) { return bin == 0u ? 0.0 : scatterGuide(first + bin); }

/// Density of the guide over solid angle, 1/sr, for a direction of the local frame.
float scatterGuidePdf(uint first, vec3 wi) {
  if (wi.z <= 0.0) return 0.0;
  const uint bin = scatterBin(squareOfHemisphere(wi));
  return (scatterGuide(first + bin + 1u) - binStart(first, bin)) * float(kScatterBins * kScatterBins) * wi.z / kPi;
}

vec3 sampleScatterGuide(uint first, vec2 u) {
  uint bin = 0u, end = kScatterBins * kScatterBins;
  while (end - bin > 1u) {
    const uint middle = (bin + end) >> 1;
    if (scatterGuide(first + middle) <= u.x) bin = middle;
    else end = middle;
  }
  const float start = binStart(first, bin), share = scatterGuide(first + bin + 1u) - start;
  const vec2 inside = vec2(clamp((u.x - start) / share, 0.0, 0.99999994), u.y);
  return sampleCosineHemisphere((vec2(bin % kScatterBins, bin / kScatterBins) + inside) / float(kScatterBins));
}

/// As sampleBsdf, but by the mixture. `weight` and `pdf` are still the BSDF's own; `scale` makes the weight that of the
/// mixture. So Russian roulette can go by what the surface keeps, not by how well the guide knows it.
BsdfSample sampleGuidedBsdf(Bsdf b, vec3 wo, GuidedScatter guided, float uLobe, vec2 u, out float scale) {
  BsdfSample s;
  if (uLobe < guided.share) {
    s.wi = sampleScatterGuide(guided.first, u);
    s.isDelta = s.isTransmission = false;
    const vec3 f = evalBsdf(b, wo, s.wi, s.pdf);
    s.weight = s.pdf > 0.0 ? f / s.pdf : vec3(0.0);
  } else {
    s = sampleBsdf(b, wo, min((uLobe - guided.share) / (1.0 - guided.share), 0.99999994), u);
  }
  const float own = (1.0 - guided.share) * s.pdf;
  scale = s.isDelta ? 1.0 / (1.0 - guided.share)
                    : s.pdf / max(own + guided.share * scatterGuidePdf(guided.first, s.wi), 1e-30);
  return s;
}

#endif
