#version 460
// Traces the rays of a queue where materials have holes or are partly transparent: they pass there.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "bindings/scene.glsl"
#include "lib/alpha.glsl"

bool acceptHit(uint triangle, vec2 barycentrics, uint rayId) { return isCovered(triangle, barycentrics, rayId); }

#include "bindings/trace.glsl"
