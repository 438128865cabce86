// One step of a path differential: transfer, reflection or refraction of a spread.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bindings/scene.glsl"
#include "lib/bsdf.glsl"
#include "lib/differential.glsl"

struct Step {
  uint kind;         // 0: transfer over t; 1: reflection; 2: refraction
  float t;
  float eta;
  Spread spread;
  vec3 direction;
  vec3 normal;
  vec3 slope;
};

layout(scalar) readonly buffer In { Step items[]; };
layout(scalar) writeonly buffer Out { Spread results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() {
  const uint i = invocationIndex();
  if (i >= count) return;
  const Step step = items[i];
  Spread s = step.spread;
  if (step.kind == 0u) transferSpread(s, step.t, step.direction, step.normal);
  else if (step.kind == 1u) reflectSpread(s, step.direction, step.normal, step.slope);
  else refractSpread(s, step.direction, step.normal, step.slope, step.eta);
  results[i] = s;
}
