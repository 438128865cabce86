// How many hits the required density asks for at a site of the importance map.
#ifndef IMPORTON_BINDINGS_SITE_DEMAND_GLSL
#define IMPORTON_BINDINGS_SITE_DEMAND_GLSL
#include "bindings/importance.glsl"

/// A site stands for its share of the surface: for kImportonsPerSite importons, at Γ / Ψ of them per m².
float hitsAskedAt(MapSettings map, uint site) {
  const float importance = max(importonImportance(site), 1e-30);
  return requiredDensityAt(map, site) * map.importonFlux * float(kImportonsPerSite) / importance;
}

#endif
