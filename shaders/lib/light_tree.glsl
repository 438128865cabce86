// A binary tree over the lights, for choosing one at a cost that grows with the logarithm of their number. A node
// knows where its lights are, how much they emit and where to. [Conty Estevez and Kulla 2018]
// The kernel defines `uvec4 lightTreeTexel(uint index)` before including this file: two per node (centre and radius of
// its lights' bounds; power, axis and cosine of the half-angle of the cone of their normals, and what it holds), the
// root first, a node's first child right after it; then the ways from the root to each light, four per texel. And
// `float unseenLight()`: the worth of lights that no photon has come from to the surroundings, in units of seen ones.
#ifndef IMPORTON_LIB_LIGHT_TREE_GLSL
#define IMPORTON_LIB_LIGHT_TREE_GLSL
#include "lib/packing.glsl"
#include "lib/sampling.glsl"

const uint kTreeLeaf = 0x80000000u;  // of a node's last word: the rest is a light; else the second child
const uint kLinearLights = 64u;  // up to so many, every light is weighed at every point; more are in the tree
const uint kGroupBits = 6u;      // so many steps down from the root lead to one of 64 groups of lights

struct TreeNode {
  float weight;
  uint content;
  bool isUndivided;  // seen or not as a whole: a light, or infinite ones
};

/// The way from the root to a light: a bit for each step, the first one lowest, set where it leads to the second child.
uint wayToLight(uint count, uint light) { return lightTreeTexel(2u * (2u * count - 1u) + light / 4u)[light % 4u]; }

/// Which of 64 bits tells that a light is seen: its own of few lights, else that of its neighbours in the tree too.
uint lightGroup(uint count, uint light) {
  return count <= kLinearLights ? light : wayToLight(count, light) & ((1u << kGroupBits) - 1u);
}

/// The share of a node's groups, `depth` steps along `way`, that are seen; of an undivided node all or none. Below the
/// groups 1: siblings there are in the same one.
float seenShare(uvec2 seen, uint way, uint depth, bool isUndivided) {
  if (depth > kGroupBits) return 1.0;
  if (depth == kGroupBits) return float(((way < 32u ? seen.x : seen.y) >> (way & 31u)) & 1u);
  // Of 2^depth groups in a row, the one that the way's first steps lead to.
  const uint everySo[6] = uint[6](0xFFFFFFFFu, 0x55555555u, 0x11111111u, 0x01010101u, 0x00010001u, 0x00000001u);
  const int groups = bitCount(seen.x & everySo[depth] << way) + bitCount(seen.y & everySo[depth] << way);
  return isUndivided ? float(min(groups, 1)) : float(groups) / float(64u >> depth);
}

/// cos(max(0, angle - spread)) for angles in 0 .. pi whose cosines are given.
float cosLess(float cosAngle, float cosSpread) {
  if (cosAngle >= cosSpread) return 1.0;
  return cosAngle * cosSpread + sqrt(max(0.0, (1.0 - cosAngle * cosAngle) * (1.0 - cosSpread * cosSpread)));
}

/// The node with the irradiance that its lights may bring to x, roughly. Never 0, so that a light is missed nowhere.
TreeNode treeNodeAt(uint node, vec3 x) {
  const uvec4 t0 = lightTreeTexel(2u * node), t1 = lightTreeTexel(2u * node + 1u);
  const float radius = uintBitsToFloat(t0.w), power = uintBitsToFloat(t1.x);
  if (isinf(radius)) return TreeNode(power, t1.w, true);  // directional lights and the environment: their irradiance
  const vec3 from = x - uintBitsToFloat(t0.xyz);
  const float d2 = dot(from, from), r2 = radius * radius;
  float cosine = 1.0;
  if (d2 > r2) {
    const float cosAxis = dot(from, unpackNormal(t1.y)) * inversesqrt(d2);
    // From the axis to x, less what the cone of normals and the size of the node may take off.
    cosine = cosLess(cosLess(cosAxis, uintBitsToFloat(t1.z)), sqrt(1.0 - r2 / d2));
  }
  return TreeNode(power * max(cosine, 0.01) / max(d2, max(r2, 1e-30)), t1.w, (t1.w & kTreeLeaf) != 0u);
}

/// A node's weight at x, less where none or few of its groups are seen there.
float seenWeight(TreeNode at, uvec2 seen, uint way, uint depth) {
  return at.weight * mix(unseenLight(), 1.0, seenShare(seen, way, depth, at.isUndivided));
}

/// A light for x, by descending from the root; u in [0, 1) chooses. `seen`: a bit for each group of lights that reaches
/// x's surroundings.
uint chooseFromTree(vec3 x, uvec2 seen, float u, out float probability) {
  probability = 1.0;
  uint node = 0u, way = 0u;
  TreeNode at = treeNodeAt(0u, x);
  for (uint depth = 0u; (at.content & kTreeLeaf) == 0u; ++depth) {
    const uint second = at.content, secondWay = way | 1u << depth;
    const TreeNode a = treeNodeAt(node + 1u, x), b = treeNodeAt(second, x);
    const float weightA = seenWeight(a, seen, way, depth + 1u), weightB = seenWeight(b, seen, secondWay, depth + 1u);
    const float share = weightA / max(weightA + weightB, 1e-38);
    const bool isFirst = u < share;
    u = min(isFirst ? u / share : (u - share) / (1.0 - share), 0.99999994);
    probability *= isFirst ? share : 1.0 - share;
    node = isFirst ? node + 1u : second;
    way = isFirst ? way : secondWay;
    at = isFirst ? a : b;
  }
  return at.content & ~kTreeLeaf;
}

/// Probability with which chooseFromTree takes `light` of `count` lights at x.
float treeProbability(uint count, uint light, vec3 x, uvec2 seen) {
  const uint way = wayToLight(count, light);
  float probability = 1.0;
  uint node = 0u;
  uint content = treeNodeAt(0u, x).content;
  for (uint depth = 0u; (content & kTreeLeaf) == 0u; ++depth) {
    const TreeNode a = treeNodeAt(node + 1u, x), b = treeNodeAt(content, x);
    const uint firstWay = way & ((1u << depth) - 1u), secondWay = firstWay | 1u << depth;
    const float weightA = seenWeight(a, seen, firstWay, depth + 1u),
                weightB = seenWeight(b, seen, secondWay, depth + 1u);
    const float share = weightA / max(weightA + weightB, 1e-38);
    const bool isFirst = ((way >> depth) & 1u) == 0u;
    probability *= isFirst ? share : 1.0 - share;
    node = isFirst ? node + 1u : content;
    content = isFirst ? a.content : b.content;
  }
  return probability;
}

#endif
