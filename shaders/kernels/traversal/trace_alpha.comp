#version 460
// Traces the rays of a queue where materials have holes or are partly transparent: they pass there.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "bindings/scene.glsl"
#include "lib/alpha.glsl"

bool acceptHit(uint stored, uint number, vec2 barycentrics, uint rayId) {
  return isCovered(stored, number, barycentrics, rayId);
}

void startRay(vec3 direction) {}
void endRay(uint slot, bool isFree) {}
const uint kMaxTurns = 21000u;

#include "bindings/trace.glsl"
