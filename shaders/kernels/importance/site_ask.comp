#version 460
// Writes how many hits of a pass the required density asks for at each site.
#extension GL_GOOGLE_include_directive : require
#include "bindings/site_demand.glsl"

layout(scalar) writeonly buffer AskedBlock { float asked[]; };
layout(push_constant, scalar) uniform Push {
  uint count;
  uint isGlobal;
} push;

void main() {
  const uint site = invocationIndex();
  if (site >= push.count) return;
  MapSettings map = params.causticMap;
  if (push.isGlobal != 0u) map = params.globalMap;
  asked[site] = hitsAskedAt(map, site);
}
