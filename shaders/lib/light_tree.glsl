// A binary tree over the lights, for choosing one at a cost that grows with the logarithm of their number. A node
// knows where its lights are, how much they emit and where to. [Conty Estevez and Kulla 2018]
// The kernel defines `uvec4 lightTreeTexel(uint index)` before including this file: two per node (centre and radius of
// its lights' bounds; power, axis and cosine of the half-angle of the cone of their normals, and what it holds), the
// root first, a node's first child right after it; then the ways from the root to each light, four per texel.
#ifndef IMPORTON_LIB_LIGHT_TREE_GLSL
#define IMPORTON_LIB_LIGHT_TREE_GLSL
#include "lib/packing.glsl"
#include "lib/sampling.glsl"

const uint kTreeLeaf = 0x80000000u;  // of a node's last word: the rest is a light; else the second child

struct TreeNode {
  float weight;
  uint content;
};

/// cos(max(0, angle - spread)) for angles in 0 .. pi whose cosines are given.
float cosLess(float cosAngle, float cosSpread) {
  if (cosAngle >= cosSpread) return 1.0;
  return cosAngle * cosSpread + sqrt(max(0.0, (1.0 - cosAngle * cosAngle) * (1.0 - cosSpread * cosSpread)));
}

/// The node with the irradiance that its lights may bring to x, roughly. Never 0, so that a light is missed nowhere.
TreeNode treeNodeAt(uint node, vec3 x) {
  const uvec4 t0 = lightTreeTexel(2u * node), t1 = lightTreeTexel(2u * node + 1u);
  const float radius = uintBitsToFloat(t0.w), power = uintBitsToFloat(t1.x);
  if (isinf(radius)) return TreeNode(power, t1.w);  // directional lights and the environment: their irradiance
  const vec3 from = x - uintBitsToFloat(t0.xyz);
  const float d2 = dot(from, from), r2 = radius * radius;
  float cosine = 1.0;
  if (d2 > r2) {
    const float cosAxis = dot(from, unpackNormal(t1.y)) * inversesqrt(d2);
    // From the axis to x, less what the cone of normals and the size of the node may take off.
    cosine = cosLess(cosLess(cosAxis, uintBitsToFloat(t1.z)), sqrt(1.0 - r2 / d2));
  }
  return TreeNode(power * max(cosine, 0.01) / max(d2, max(r2, 1e-30)), t1.w);
}

/// A light for x, by descending from the root; u in [0, 1) chooses.
uint chooseFromTree(vec3 x, float u, out float probability) {
  probability = 1.0;
  uint node = 0u;
  TreeNode at = treeNodeAt(0u, x);
  while ((at.content & kTreeLeaf) == 0u) {
    const uint second = at.content;
    const TreeNode a = treeNodeAt(node + 1u, x), b = treeNodeAt(second, x);
    const float share = a.weight / max(a.weight + b.weight, 1e-38);
    const bool isFirst = u < share;
    u = min(isFirst ? u / share : (u - share) / (1.0 - share), 0.99999994);
    probability *= isFirst ? share : 1.0 - share;
    node = isFirst ? node + 1u : second;
    at = isFirst ? a : b;
  }
  return at.content & ~kTreeLeaf;
}

/// Probability with which chooseFromTree takes `light` of `count` lights at x.
float treeProbability(uint count, uint light, vec3 x) {
  const uint way = lightTreeTexel(2u * (2u * count - 1u) + light / 4u)[light % 4u];
  float probability = 1.0;
  uint node = 0u;
  uint content = treeNodeAt(0u, x).content;
  for (uint depth = 0u; (content & kTreeLeaf) == 0u; ++depth) {
    const TreeNode a = treeNodeAt(node + 1u, x), b = treeNodeAt(content, x);
    const float share = a.weight / max(a.weight + b.weight, 1e-38);
    const bool isFirst = ((way >> depth) & 1u) == 0u;
    probability *= isFirst ? share : 1.0 - share;
    node = isFirst ? node + 1u : content;
    content = isFirst ? a.content : b.content;
  }
  return probability;
}

#endif
