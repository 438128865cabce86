#version 460
// Traces shadow rays where smooth thin surfaces let light go straight on: each dims the light of the rays that pass it.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "bindings/scene.glsl"
#include "lib/alpha.glsl"
#include "lib/bsdf.glsl"

layout(scalar) buffer ShadowLightBlock { vec3 shadowLight[]; };

// Of the ray at hand.
vec3 passedDirection;
vec3 passedShare;

bool acceptHit(uint stored, uint number, vec2 barycentrics, uint rayId) {
  if (!isCovered(stored, number, barycentrics, rayId)) return false;
  if ((materialTexel(kMaterialTexels * triangleTexel(stored).w + 5u).z & kMaterialPane) == 0u) return true;
  const Surface s = loadSurface(number, barycentrics, passedDirection);
  const float cosOut = -dot(passedDirection, s.shadingNormal);
  passedShare *= straightPassed(makeBsdf(s, cosOut), -passedDirection * s.frame);
  return maxComponent(passedShare) <= 0.0;
}

void startRay(vec3 direction) {
  passedDirection = direction;
  passedShare = vec3(1.0);
}

void endRay(uint slot, bool isFree) {
  if (isFree) shadowLight[slot] *= passedShare;
}

// What a pane's textures take of loops leaves so many.
const uint kMaxTurns = 14000u;

#include "bindings/trace.glsl"
