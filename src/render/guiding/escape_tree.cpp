#include "render/guiding/escape_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <random>

namespace importon {
namespace {

using glm::dvec3;

constexpr std::size_t kDimensions = 4;
constexpr std::size_t kLeastInLeaf = 16, kMostLeaves = 4096, kFewest = 64;
using Point = std::array<double, kDimensions>;

struct Sample {
  Point at;
  double weight;
  double pdf;  // of its direction by power, 1/sr
};

struct Region {
  Point low, high;
};

/// The first two axes of frameAround of shaders/lib/sampling.glsl.
std::array<dvec3, 2> axesAcross(const dvec3& n) {
  const double s = n.z >= 0 ? 1 : -1, a = -1 / (s + n.z), b = n.x * n.y * a;
  return {dvec3(1 + s * n.x * n.x * a, s * b, -s * n.x), dvec3(b, s + n.y * n.y * a, -n.y)};
}

/// The weighted mean of where importance escaped, from which places are measured.
dvec3 centreOf(std::span<const Escape> escapes) {
  dvec3 sum(0.0);
  double weight = 0;
  for (const Escape& e : escapes) {
    sum += static_cast<double>(e.weight) * dvec3(e.origin);
    weight += static_cast<double>(e.weight);
  }
  return dvec3(vec3(sum / std::max(weight, 1e-300)));
}

std::vector<Sample> samplesOf(std::span<const Escape> escapes, const dvec3& centre) {
  std::vector<Sample> samples;
  for (const Escape& e : escapes) {
    if (!(e.weight > 0)) continue;
    const auto [across, along] = axesAcross(-dvec3(e.direction));
    const dvec3 place = dvec3(e.origin) - centre;
    samples.push_back({{static_cast<double>(e.place.x), static_cast<double>(e.place.y), glm::dot(place, across),
                        glm::dot(place, along)},
                       static_cast<double>(e.weight),
                       static_cast<double>(e.pdf)});
  }
  return samples;
}

Point deviationsOf(std::span<const Sample> samples) {
  Point deviations{};
  for (std::size_t d = 0; d < kDimensions; ++d) {
    double weight = 0, mean = 0, square = 0;
    for (const Sample& s : samples) {
      weight += s.weight;
      mean += s.weight * s.at[d];
      square += s.weight * s.at[d] * s.at[d];
    }
    mean /= weight;
    deviations[d] = std::sqrt(std::max(square / weight - mean * mean, 0.0));
  }
  return deviations;
}

/// How widely samples scatter, but at least a little, by the sizes of all directions and of the disc.
Point scaleOf(std::span<const Sample> samples, double discArea) {
  constexpr double kLeast = 1e-4;
  Point scale = deviationsOf(samples);
  for (std::size_t d = 0; d < kDimensions; ++d)
    scale[d] = std::max(scale[d], kLeast * (d < 2 ? 1 : std::sqrt(discArea)));
  return scale;
}

/// Moves samples apart by up to a hundredth of `scale`, so that no two are at one place, where boxes would have no
/// size.
void moveApart(std::span<Sample> samples, const Point& scale) {
  std::minstd_rand random;
  for (Sample& s : samples)
    for (std::size_t d = 0; d < kDimensions; ++d) {
      const double share = static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max());
      s.at[d] += 0.02 * scale[d] * (share - 0.5);
      if (d < 2) s.at[d] = std::clamp(s.at[d], 0.0, 1.0);
    }
}

/// Builds the tree depth first into its texels.
class Builder {
 public:
  Builder(std::uint32_t leaves, const Point& scale, const dvec3& centre) : leaves_(leaves), scale_(scale) {
    texels_.resize(3 * 2 * std::size_t{leaves});
    const vec3 c(centre);
    texels_[0] = {std::bit_cast<uint>(c.x), std::bit_cast<uint>(c.y), std::bit_cast<uint>(c.z), leaves};
  }

  void build(std::span<Sample> samples, const Region& region, std::uint32_t node) {
    addBox(samples, region, node);
    if (node >= leaves_) return;
    const std::size_t dimension = widest(samples);
    std::ranges::sort(samples, {}, [&](const Sample& s) { return s.at[dimension]; });
    const std::size_t middle = weightedMiddle(samples);
    const auto split = static_cast<float>(0.5 * (samples[middle - 1].at[dimension] + samples[middle].at[dimension]));
    texels_[3 * std::size_t{node} + 2] = {std::bit_cast<uint>(split), static_cast<uint>(dimension), 0, 0};
    Region below = region, above = region;
    below.high[dimension] = above.low[dimension] = static_cast<double>(split);
    build(samples.first(middle), below, 2 * node);
    build(samples.subspan(middle), above, 2 * node + 1);
  }

  [[nodiscard]] const std::vector<uvec4>& texels() const { return texels_; }

 private:
  [[nodiscard]] std::size_t widest(std::span<const Sample> samples) const {
    const Point deviations = deviationsOf(samples);
    std::size_t best = 0;
    for (std::size_t d = 1; d < kDimensions; ++d)
      if (deviations[d] * scale_[best] > deviations[best] * scale_[d]) best = d;
    return best;
  }

  /// As much weight before it as from it on, as nearly as each leaf below can get a sample at least.
  [[nodiscard]] static std::size_t weightedMiddle(std::span<const Sample> samples) {
    double total = 0, sum = 0;
    for (const Sample& s : samples) total += s.weight;
    std::size_t middle = 0;
    while (middle < samples.size() && sum + samples[middle].weight < 0.5 * total) sum += samples[middle++].weight;
    // Weights differ little; where they do, counts keep leaves from running empty.
    return std::clamp(middle, samples.size() / 3 + 1, samples.size() - samples.size() / 3 - 1);
  }

  /// The box of its samples, wider by what they leave unknown, within its region.
  void addBox(std::span<const Sample> samples, const Region& region, std::uint32_t node) {
    std::array<float, kDimensions> low{}, size{};
    for (std::size_t d = 0; d < kDimensions; ++d) {
      const auto [least, most] = std::ranges::minmax(samples, {}, [&](const Sample& s) { return s.at[d]; });
      const double margin =
          std::max((most.at[d] - least.at[d]) / static_cast<double>(samples.size()), 1e-3 * scale_[d]);
      low[d] = static_cast<float>(std::max(least.at[d] - margin, region.low[d]));
      size[d] = static_cast<float>(std::min(most.at[d] + margin, region.high[d]) - static_cast<double>(low[d]));
    }
    texels_[3 * std::size_t{node}] = std::bit_cast<uvec4>(low);
    texels_[3 * std::size_t{node} + 1] = std::bit_cast<uvec4>(size);
  }

  std::uint32_t leaves_;
  Point scale_;
  std::vector<uvec4> texels_;
};

/// Of a box among as many, uniform, 1/(m² sr); 0 outside of it.
double boxDensity(const std::vector<uvec4>& texels, std::uint32_t node, std::uint32_t boxes, const Point& at) {
  const auto low = std::bit_cast<std::array<float, kDimensions>>(texels[3 * std::size_t{node}]);
  const auto size = std::bit_cast<std::array<float, kDimensions>>(texels[3 * std::size_t{node} + 1]);
  double volume = 4 * glm::pi<double>() * boxes;
  for (std::size_t d = 0; d < kDimensions; ++d) {
    const double x = at[d] - static_cast<double>(low[d]);
    if (x < 0 || x > static_cast<double>(size[d])) return 0;
    volume *= static_cast<double>(size[d]);
  }
  return 1 / volume;
}

/// Of all levels, by their shares, which add up to kGuidedEscapes.
double guidedDensity(const std::vector<uvec4>& texels, const Point& at) {
  const std::uint32_t leaves = texels[0].w;
  std::uint32_t node = 1;
  while (node < leaves) {
    const uvec4 split = texels[3 * std::size_t{node} + 2];
    node = 2 * node + (static_cast<float>(at[split.y]) < std::bit_cast<float>(split.x) ? 0 : 1);
  }
  double density = 0, share = static_cast<double>(kEscapeShare);
  for (std::uint32_t level = 0; level < kEscapeLevels; ++level, share *= 0.5) {
    const std::uint32_t up = std::min(level * kEscapeStep, static_cast<std::uint32_t>(std::bit_width(leaves)) - 1);
    density += share * boxDensity(texels, node >> up, leaves >> up, at);
  }
  return density;
}

}  // namespace

EscapeTree buildEscapeTree(std::span<const Escape> escapes, double discArea) {
  const dvec3 centre = centreOf(escapes);
  std::vector<Sample> samples = samplesOf(escapes, centre);
  EscapeTree tree;
  if (samples.size() < kFewest) return tree;
  const Point scale = scaleOf(samples, discArea);
  moveApart(samples, scale);
  tree.leaves = static_cast<std::uint32_t>(std::min(std::bit_floor(samples.size() / kLeastInLeaf), kMostLeaves));
  constexpr double kFar = 1e30;
  Builder builder(tree.leaves, scale, centre);
  builder.build(samples, {{0, 0, -kFar, -kFar}, {1, 1, kFar, kFar}}, 1);
  tree.texels = builder.texels();
  double better = 0, all = 0;
  for (const Sample& s : samples) {
    const double byPower = s.pdf / discArea;
    const double mixed = guidedDensity(tree.texels, s.at) + (1 - static_cast<double>(kGuidedEscapes)) * byPower;
    all += s.weight;
    if (mixed > EscapeTree::kWorthIt * byPower) better += s.weight;
  }
  tree.betterShare = better / all;
  return tree;
}

}  // namespace importon
