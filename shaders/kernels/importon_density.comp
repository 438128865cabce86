#version 460
// Importance at each importon from its M nearest: Γ = Σ Ψ / (π r_M²) over the M-1 inner ones, which removes the
// bias M/(M-1) of counting the one that sets the radius. [Suykens, talk; METHOD]
#extension GL_GOOGLE_include_directive : require
#include "bindings/selection.glsl"
#include "bindings/stored.glsl"
#include "lib/density.glsl"

layout(scalar, binding = kBindingNeighbours) readonly buffer LevelsBlock { uint startLevels[]; };
layout(binding = kBindingWeights) uniform samplerBuffer weights;
layout(push_constant, scalar) uniform PushBlock { ImportonDensityPush push; };

const uint kBins = 32u;
uint bins[kBins];

/// Squared distance of the candidate at hand, or -1 if it lies on another surface.
float candidateDistance(GridSearch search, vec3 normal) {
  const vec3 offset = search.position - search.centre;
  if (dot(mapPointNormal(search.packed), normal) < 0.7 || abs(dot(offset, normal)) > 0.25 * search.radius) return -1.0;
  return dot(offset, offset);
}

/// Narrows [low, high) of squared distance to the bin in which the count reaches `nearest`; false: it does not.
bool narrow(vec3 centre, vec3 normal, uint level, float radius, inout float low, inout float high, inout uint inner) {
  for (uint b = 0u; b < kBins; ++b) bins[b] = 0u;
  const float scale = float(kBins) / (high - low);
  GridSearch search = beginSearchLevels(storedFrame(), centre, radius, level, level);
  while (nextPoint(search)) {
    const float d2 = candidateDistance(search, normal);
    if (d2 >= low && d2 < high) ++bins[min(uint((d2 - low) * scale), kBins - 1u)];
  }
  for (uint b = 0u; b < kBins; ++b) {
    if (inner + bins[b] >= push.nearest) {
      const float width = (high - low) / float(kBins);
      low += width * float(b);
      high = low + width * 1.0001;
      return true;
    }
    inner += bins[b];
  }
  return false;
}

/// Γ from all importons nearer than `limit` (squared).
float importanceWithin(vec3 centre, vec3 normal, uint level, float radius, float limit) {
  float sum = 0.0, outermost = 0.0, outerWeight = 0.0;
  uint count = 0u;
  GridSearch search = beginSearchLevels(storedFrame(), centre, radius, level, level);
  while (nextPoint(search)) {
    const float d2 = candidateDistance(search, normal);
    if (d2 < 0.0 || d2 >= limit) continue;
    const float weight = texelFetch(weights, int(search.index)).x;
    sum += weight;
    ++count;
    if (d2 >= outermost) {
      outermost = d2;
      outerWeight = weight;
    }
  }
  if (count < 3u || outermost <= 0.0) return sum / (kPi * limit);
  return (sum - outerWeight) / (kPi * outermost);
}

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterSelected]) return;
  const MapPoint point = recordPoints[selection[i]];
  const vec3 normal = mapPointNormal(point.packed);
  uint level = startLevels[i];
  float radius = gridCellEdge(storedFrame(), level);
  float low = 0.0, high = radius * radius;
  uint inner = 0u;
  bool isFound = narrow(point.position, normal, level, radius, low, high, inner);
  if (!isFound && level > 0u) {
    --level;
    radius *= 2.0;
    low = 0.0;
    high = radius * radius;
    inner = 0u;
    isFound = narrow(point.position, normal, level, radius, low, high, inner);
  }
  if (isFound) isFound = narrow(point.position, normal, level, radius, low, high, inner);
  required[i] = importanceWithin(point.position, normal, level, radius, high);
}
