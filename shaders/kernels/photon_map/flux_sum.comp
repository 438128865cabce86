#version 460
// Sums fixed-point flux exactly: of the selected hits, of those that were kept with their weights, or of the stored
// photons.
#extension GL_GOOGLE_include_directive : require
#include "bindings/photons.glsl"
#include "bindings/selection.glsl"

layout(scalar) buffer TotalsBlock { uint totals[]; };  // hits, map, kept: 3 channels of 2 words
layout(push_constant, scalar) uniform Push {
  uint what;    // kSum*
  uint source;
} push;

void main() {
  const uint tile = invocationIndex();
  const uint count = counters[push.source];
  const uint begin = tile * kTileSize;
  if (begin >= count) return;
  const uint end = min(begin + kTileSize, count);
  uvec2 sums[3] = uvec2[3](uvec2(0u), uvec2(0u), uvec2(0u));
  for (uint i = begin; i < end; ++i) {
    vec3 flux = vec3(0.0);
    if (push.what != kSumMap) flux = records[selection[i]].flux * params.fluxScale;
    if (push.what == kSumKept) flux *= keep[i] != 0u ? required[i] : 0.0;
    for (uint c = 0u; c < 3u; ++c)
      sums[c] = addFixed(sums[c], push.what == kSumMap ? photonChannel(i, c) : fixedFromFloat(flux[c]));
  }
  for (uint c = 0u; c < 3u; ++c) {
    const uint at = 6u * push.what + 2u * c;
    const uint before = atomicAdd(totals[at], sums[c].x);
    atomicAdd(totals[at + 1u], sums[c].y + uint(before + sums[c].x < before));
  }
}
