// How many hits the required density asks for at a site of the importance map.
#ifndef IMPORTON_BINDINGS_SITE_DEMAND_GLSL
#define IMPORTON_BINDINGS_SITE_DEMAND_GLSL
#include "bindings/importance.glsl"

/// A site stands for its share of the surface: for kImportonsPerSite importons, at Γ / Ψ of them per m².
float hitsAskedAt(MapSettings map, uint site) {
  const float importance = max(importonImportance(site), 1e-30);
  return requiredDensityAt(map, site) * map.importonFlux * float(kImportonsPerSite) / importance;
}

/// How much a place counts, 0 to 1, by its importance over the scene's mean: all that are more important than most
/// count nearly the same, or, for potential, in proportion up to a bound.
const float kMostTimesMean = 16.0;

float weightOfPlace(float importance, float meanImportance, bool isPotential) {
  if (isPotential) return min(importance / (kMostTimesMean * meanImportance), 1.0);
  return importance / (importance + meanImportance);
}

/// What hits counted at other times leave missing at a site, of 1; never nothing, for counts err.
const float kLeastDeficit = 0.05;

/// `hitsPerPass`: in a pass, for each hit that was counted.
float deficitAt(MapSettings map, uint site, float hitsPerPass) {
  const float hits = float(texelFetch(importonHitsWords, int(site)).x) * hitsPerPass;
  return max(1.0 - hits / hitsAskedAt(map, site), kLeastDeficit);
}

#endif
