#version 460
// What the footprints of the importons near a site ask for, pixels/m²: the most that one path does bounds the error of
// a pixel; the sum of all, that of the image. [METHOD; Suykens, talk] Near is the disc of the importance estimate.
#extension GL_GOOGLE_include_directive : require
#include "bindings/importance_bound.glsl"
#include "bindings/selection.glsl"
#include "bindings/stored.glsl"
#include "lib/sampling.glsl"

uniform samplerBuffer weightsWords;
layout(scalar) readonly buffer FootprintsBlock { float footprints[]; };
layout(push_constant, scalar) uniform Push {
  uint levels;
} push;

const float kSpokenFor = 16.0;  // importons of like footprints in the disc for which one of them speaks

/// The finest level in use with cells of at least the radius.
uint levelFor(GridFrame frame, float radius) {
  uint levels = push.levels;
  while (bitCount(levels) > 1 && gridCellEdge(frame, uint(findMSB(levels))) < radius) levels ^= 1u << findMSB(levels);
  return levels == 0u ? 0u : uint(findMSB(levels));
}

void main() {
  const uint site = invocationIndex();
  if (site >= counters[kCounterSites]) return;
  const MapPoint point = recordPoints[selection[site * kImportonsPerSite]];
  const vec3 normal = mapPointNormal(point.packed);
  const GridFrame frame = storedFrame();
  const float limit = bounds[site];  // m²
  const uint level = levelFor(frame, sqrt(limit));
  const float radius = gridCellEdge(frame, level);
  float most = 0.0, sum = 0.0;
  Walk walk = beginWalkLevels(frame, point.position, normal, radius, 1u << level);
  while (nextPoint(walk)) {
    const float d2 = likeDistance(walk, normal, radius);
    if (d2 < 0.0 || d2 >= limit) continue;
    // Of the footprint density g, and w pixels for each importon, there are g/w per m².
    const float density =
        footprints[selection[texelFetch(storedOrderWords, int(walk.index)).x / uint(bitCount(push.levels))]];
    const float weight = texelFetch(weightsWords, int(walk.index)).x;
    const float area = min(kSpokenFor * weight / max(density, 1e-30), kPi * limit);
    if (kPi * d2 >= area) continue;
    most = max(most, density);
    sum += weight / area;
  }
  bounds[site] = kImportanceBound == kBoundPixel ? most : sum;
}
