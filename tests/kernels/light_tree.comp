// Chooses a light of a tree for a point, and states the probability of another one.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/scene_data.h"
#include "lib/dispatch.glsl"

struct Query {
  vec3 x;
  float u;
  uint light;
  uvec2 seen;
};
struct Answer {
  uint chosen;
  float chosenProbability;
  float probability;
};

layout(binding = 0, scalar) readonly buffer In { Query items[]; };
layout(binding = 1, scalar) writeonly buffer Out { Answer results[]; };
layout(binding = 2) uniform usamplerBuffer treeTexels;
layout(push_constant, scalar) uniform Push {
  uint count;
  uint lights;
};

uvec4 lightTreeTexel(uint i) { return texelFetch(treeTexels, int(i)); }
float unseenLight() { return 0.05; }
#include "lib/light_tree.glsl"

void main() {
  const uint i = invocationIndex();
  if (i >= count) return;
  Answer a;
  a.chosen = chooseFromTree(items[i].x, items[i].seen, items[i].u, a.chosenProbability);
  a.probability = treeProbability(lights, items[i].light, items[i].x, items[i].seen);
  results[i] = a;
}
