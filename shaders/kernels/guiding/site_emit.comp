#version 460
// Importance leaves the places that the image reads, as power leaves lights, and is then traced as photons are: what it
// meets is where photons can come from. [Peter and Pietrek 1998]
#extension GL_GOOGLE_include_directive : require
#include "bindings/site_demand.glsl"
#include "bindings/paths.glsl"
#include "lib/photon_stream.glsl"
#include "lib/sampling.glsl"

layout(push_constant, scalar) uniform Push {
  uint first;
  uint count;
  uint sites;
  float meanImportance;  // pixels/m²
  float hitsPerPass;     // for each hit that was counted at a site; 0: deficits do not matter
  uint isPotential;      // places count in proportion to their importance
  uint isGlobal;         // the sites are of the global map
} push;

/// How far off its surface importance starts, of the scene's extent: sites know no bound of their error.
const float kOffset = 1e-4;

void main() {
  const uint slot = invocationIndex();
  if (slot >= push.count) return;
  const uint item = push.first + slot;
  MapSettings map = params.causticMap;
  if (push.isGlobal != 0u) map = params.globalMap;
  const uint stream = photonStream(kStreamSites, map, item), index = photonIndex(map, item);
  const uint site = min(uint(sequencePoint(stream, index, kPairPosition).x * float(push.sites)), push.sites - 1u);
  const uvec4 point = importonPoint(site);
  const vec3 normal = mapPointNormal(point.w);
  const vec3 direction = frameAround(normal) * sampleCosineHemisphere(sequencePoint(stream, index, kPairDirection));
  // Sites lie as densely as importance is high; the unit is such that no flux is above 1.
  const float importance = max(importonImportance(site), 1e-30);
  const float unit = push.meanImportance * (push.isPotential != 0u ? kMostTimesMean : 1.0);
  float flux = weightOfPlace(importance, push.meanImportance, push.isPotential != 0u) * unit / importance;
  if (push.hitsPerPass > 0.0) flux *= deficitAt(map, site, push.hitsPerPass);
  PathState path;
  path.throughput = vec3(flux);
  path.flags = 0u;
  path.id = item;
  path.media = uvec2(0u);
  path.source = kNone;
  path.pdfSolidAngle = path.lightWeight = path.distance = 0.0;
  rays[slot] =
      Ray(uintBitsToFloat(point.xyz) + normal * (kOffset * params.gridExtent), kInfinity, direction, hash(index));
  paths[slot] = path;
  queue[slot] = slot;
}
