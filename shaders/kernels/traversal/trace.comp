#version 460
// Traces the rays of a queue: the nearest hit of each, or whether anything is in its way.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "bindings/tables.glsl"

bool acceptHit(uint stored, uint number, vec2 barycentrics, uint rayId) { return true; }

void startRay(vec3 direction) {}
void endRay(uint slot, bool isFree) {}
const uint kMaxTurns = 21000u;

#include "bindings/trace.glsl"
