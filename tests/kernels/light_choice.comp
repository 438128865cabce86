// Chooses one of a scene's lights for a point, and states the probability of another one.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "bindings/lights.glsl"

struct Query {
  vec3 x;
  float u;
  uint light;
};
struct Answer {
  uint chosen;
  float chosenProbability;
  float probability;
  float rest;
};

layout(scalar) readonly buffer In { Query items[]; };
layout(scalar) writeonly buffer Out { Answer results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() {
  const uint i = invocationIndex();
  if (i >= count) return;
  Answer a;
  float weightSum;
  a.rest = items[i].u;
  a.chosen = chooseLight(params.lightCount, items[i].x, a.rest, a.chosenProbability, weightSum);
  a.probability = lightProbability(params.lightCount, items[i].light, items[i].x, weightSum);
  results[i] = a;
}
