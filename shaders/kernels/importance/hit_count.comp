#version 460
// Counts the selected hits of a pilot batch near each importon: what a pass is going to bring there.
#extension GL_GOOGLE_include_directive : require
#include "bindings/importance.glsl"
#include "bindings/selection.glsl"

layout(scalar) buffer ImportonHitsBlock { uint hitsOut[]; };
layout(push_constant, scalar) uniform Push {
  uint isGlobal;
  uint weight;  // hits that each stands for
} push;

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterSelected]) return;
  const uint levels = push.isGlobal != 0u ? params.globalMap.importonLevels : params.causticMap.importonLevels;
  const MapPoint point = recordPoints[selection[i]];
  const uint importon = importonAt(importonFrame(), levels, point.position, mapPointNormal(point.packed));
  if (importon != kNone) atomicAdd(hitsOut[importon], push.weight);
}
