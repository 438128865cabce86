#include "render/device_scene/light_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "scene/packing.h"
#include "shared/elementary.h"

namespace importon {
namespace {

using namespace elementary;

constexpr uint kTreeLeaf = 0x80000000u;
constexpr float kFloatPi = 3.14159265f;

float floatMeanOf(const vec3& color) { return (color.x + color.y + color.z) / 3.0f; }

/// A cone around both. [Conty Estevez and Kulla 2018, listing 1]
void mergeCones(LightBounds& a, const LightBounds& b) {
  const float angleA = portableAcos(std::clamp(a.cosCone, -1.0f, 1.0f)),
              angleB = portableAcos(std::clamp(b.cosCone, -1.0f, 1.0f));
  const float between = portableAcos(std::clamp(glm::dot(a.axis, b.axis), -1.0f, 1.0f));
  if (between + angleB <= angleA) return;
  if (between + angleA <= angleB) {
    a.axis = b.axis;
    a.cosCone = b.cosCone;
    return;
  }
  const float angle = 0.5f * (angleA + between + angleB);
  const vec3 across = b.axis - glm::dot(a.axis, b.axis) * a.axis;
  if (angle >= kFloatPi || glm::dot(across, across) < 1e-12f) {
    a.cosCone = -1;
    return;
  }
  const float turn = angle - angleA;
  a.axis = glm::normalize(portableCos(turn) * a.axis + portableSin(turn) * glm::normalize(across));
  a.cosCone = portableCos(angle);
}

LightBounds merge(LightBounds a, const LightBounds& b) {
  a.power += b.power;
  if (a.isInfinite) return a;
  if (b.isInfinite) {
    a.isInfinite = true;
    return a;
  }
  a.low = glm::min(a.low, b.low);
  a.high = glm::max(a.high, b.high);
  mergeCones(a, b);
  return a;
}

class Builder {
 public:
  explicit Builder(std::span<const LightBounds> lights) : lights_(lights), order_(lights.size()), ways_(lights.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    std::stable_partition(order_.begin(), order_.end(), [&](uint i) { return !lights_[i].isInfinite; });
  }

  std::vector<uvec4> build() {
    nodes_.reserve(2 * order_.size());
    addNode(0, order_.size(), 0, 0);
    std::vector<uvec4> texels;
    for (const Node& node : nodes_) write(node, texels);
    for (std::size_t i = 0; i < ways_.size(); i += 4) {
      uvec4 texel(0u);
      for (std::size_t k = i; k < std::min(i + 4, ways_.size()); ++k) texel[static_cast<int>(k - i)] = ways_[k];
      texels.push_back(texel);
    }
    return texels;
  }

 private:
  struct Node {
    LightBounds bounds;
    uint content = 0;
  };

  LightBounds addNode(std::size_t begin, std::size_t end, uint way, uint depth) {
    const std::size_t index = nodes_.size();
    nodes_.emplace_back();
    if (end - begin == 1) {
      nodes_[index] = {lights_[order_[begin]], kTreeLeaf | order_[begin]};
      ways_[order_[begin]] = way;
      return nodes_[index].bounds;
    }
    const std::size_t middle = split(begin, end);
    const LightBounds first = addNode(begin, middle, way, depth + 1);
    const auto second = static_cast<uint>(nodes_.size());
    const LightBounds both = merge(first, addNode(middle, end, way | 1u << depth, depth + 1));
    nodes_[index] = {both, second};
    return both;
  }

  /// Where [begin, end) is divided: infinite lights apart from the others, else half by half along the longest
  /// side.
  std::size_t split(std::size_t begin, std::size_t end) {
    const auto first = order_.begin() + static_cast<std::ptrdiff_t>(begin),
               last = order_.begin() + static_cast<std::ptrdiff_t>(end);
    const auto firstInfinite = std::find_if(first, last, [&](uint i) { return lights_[i].isInfinite; });
    if (firstInfinite != last && firstInfinite != first) return begin + static_cast<std::size_t>(firstInfinite - first);
    const auto middle = first + (last - first) / 2;
    if (firstInfinite == last) {
      vec3 low(std::numeric_limits<float>::infinity()), high = -low;
      for (auto i = first; i != last; ++i) {
        low = glm::min(low, centre(*i));
        high = glm::max(high, centre(*i));
      }
      const vec3 sides = high - low;
      const int axis = sides.x >= sides.y && sides.x >= sides.z ? 0 : sides.y >= sides.z ? 1 : 2;
      std::nth_element(first, middle, last, [&](uint a, uint b) {
        const float ca = centre(a)[axis], cb = centre(b)[axis];
        return ca != cb ? ca < cb : a < b;
      });
    }
    return begin + static_cast<std::size_t>(middle - first);
  }

  vec3 centre(uint light) const { return 0.5f * lights_[light].low + 0.5f * lights_[light].high; }

  static void write(const Node& node, std::vector<uvec4>& texels) {
    const LightBounds& b = node.bounds;
    const vec3 centre = 0.5f * b.low + 0.5f * b.high;
    const float radius = b.isInfinite ? std::numeric_limits<float>::infinity() : 0.5f * glm::length(b.high - b.low);
    // The axis is rounded when packed: by less than this.
    const float cosCone = portableCos(std::min(portableAcos(std::clamp(b.cosCone, -1.0f, 1.0f)) + 1e-3f, kFloatPi));
    texels.emplace_back(std::bit_cast<uint>(centre.x), std::bit_cast<uint>(centre.y), std::bit_cast<uint>(centre.z),
                        std::bit_cast<uint>(radius));
    texels.emplace_back(std::bit_cast<uint>(b.power), packNormal(b.axis), std::bit_cast<uint>(cosCone), node.content);
  }

  std::span<const LightBounds> lights_;
  std::vector<uint> order_;
  std::vector<uint> ways_;
  std::vector<Node> nodes_;
};

}  // namespace

LightBounds boundLight(const Scene& scene, const Light& light) {
  LightBounds bounds;
  bounds.power = light.power;
  if (light.kind == kLightDirectional || light.kind == kLightEnvironment) {
    bounds.isInfinite = true;
    // In the unit of a node's weight, power over squared distance: a Lambertian light brings its power / (pi
    // d²).
    bounds.power = kFloatPi * floatMeanOf(light.emission) * (light.kind == kLightEnvironment ? kFloatPi : 1.0f);
    return bounds;
  }
  bounds.low = bounds.high = light.position;
  if (light.kind == kLightPoint) bounds.power *= 0.25f;  // all around, not by the cosine
  if (light.kind == kLightSpot || light.kind == kLightProfile) {
    bounds.axis = light.direction;
    bounds.cosCone = light.cosOuter;
    bounds.power = kFloatPi * floatMeanOf(light.emission);
  }
  if (light.kind != kLightTriangle) return bounds;
  const Triangle& t = scene.triangles[light.triangle];
  for (const uint vertex : {t.v0, t.v1, t.v2}) {
    bounds.low = glm::min(bounds.low, scene.positions[vertex]);
    bounds.high = glm::max(bounds.high, scene.positions[vertex]);
  }
  bounds.axis = light.direction;
  bounds.cosCone = light.isTwoSided != 0 ? -1.0f : 1.0f;
  return bounds;
}

std::vector<uvec4> buildLightTree(std::span<const LightBounds> lights) { return Builder(lights).build(); }

}  // namespace importon
