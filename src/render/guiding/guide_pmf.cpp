#include "render/guiding/guide_pmf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace importon {
namespace {

constexpr std::array kDefensiveWeights{0.15, 0.3, 0.5, 0.75, 1.0};
constexpr double kEvenWeight = 0.075;  // evenly over cells, whatever was learned: for lights much weaker than others

/// Sum over cells of the second moment over the share: up to a factor and a constant, the variance of what is learned.
double varianceOf(std::span<const double> moments, std::span<const double> shares) {
  double sum = 0;
  for (std::size_t i = 0; i < moments.size(); ++i)
    if (moments[i] > 0) sum += moments[i] / std::max(shares[i], 1e-300);
  return sum;
}

std::vector<double> sumOf(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> sum(a.size());
  std::transform(a.begin(), a.end(), b.begin(), sum.begin(), std::plus());
  return sum;
}

}  // namespace

std::vector<double> smoothBins(const std::vector<double>& moments, std::size_t groups, int bins) {
  std::vector<double> out(moments.size());
  const std::size_t perGroup = static_cast<std::size_t>(bins) * static_cast<std::size_t>(bins);
  for (std::size_t group = 0; group < groups; ++group) {
    for (int y = 0; y < bins; ++y) {
      for (int x = 0; x < bins; ++x) {
        double sum = 0;
        for (int qy = std::max(y - 1, 0); qy <= std::min(y + 1, bins - 1); ++qy)
          for (int qx = std::max(x - 1, 0); qx <= std::min(x + 1, bins - 1); ++qx)
            sum += moments[group * perGroup + static_cast<std::size_t>(qy * bins + qx)] * (qx == x && qy == y ? 8 : 1);
        out[group * perGroup + static_cast<std::size_t>(y * bins + x)] = sum / 16;
      }
    }
  }
  return out;
}

std::vector<double> startingPmf(const std::vector<double>& powers, std::size_t cellsPerLight) {
  std::vector<double> cells;
  const auto perLight = static_cast<double>(cellsPerLight), lights = static_cast<double>(powers.size());
  for (const double power : powers) cells.insert(cells.end(), cellsPerLight, 0.5 * (power + 1.0 / lights) / perLight);
  return cells;
}

std::vector<double> guidePmf(const std::vector<double>& moments, const std::vector<double>& powers, int bins,
                             GuideWeight guideWeight, double defensiveWeight) {
  const std::size_t perLight = moments.size() / powers.size();
  std::vector<double> weights = smoothBins(moments, powers.size(), bins);
  if (guideWeight != GuideWeight::potential)
    for (double& weight : weights) weight = std::sqrt(weight);
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double even = kEvenWeight / static_cast<double>(moments.size());
  std::vector<double> cells;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const double power = powers[i / perLight] / static_cast<double>(perLight);
    const double guided = total > 0 ? weights[i] / total : power;
    cells.push_back(even + (defensiveWeight - kEvenWeight) * power + (1 - defensiveWeight) * guided);
  }
  return cells;
}

GuidePmf chooseGuidePmf(const std::vector<double>& evenMoments, const std::vector<double>& oddMoments,
                        const std::vector<double>& powers, int bins, GuideWeight guideWeight) {
  const std::size_t perLight = evenMoments.size() / powers.size();
  std::vector<double> byPower(evenMoments.size());
  for (std::size_t i = 0; i < byPower.size(); ++i) byPower[i] = powers[i / perLight] / static_cast<double>(perLight);
  const std::vector<double> all = sumOf(evenMoments, oddMoments);
  const double plain = varianceOf(all, byPower);
  GuidePmf chosen;
  double least = std::numeric_limits<double>::max();
  for (const double defensiveWeight : kDefensiveWeights) {
    const auto byHalf = [&](const std::vector<double>& half) {
      return guidePmf(half, powers, bins, guideWeight, defensiveWeight);
    };
    const double variance = varianceOf(oddMoments, byHalf(evenMoments)) + varianceOf(evenMoments, byHalf(oddMoments));
    if (variance >= least) continue;
    least = variance;
    chosen.defensiveWeight = defensiveWeight;
    if (guideWeight == GuideWeight::potential) break;
  }
  if (least > 0) chosen.gain = plain / least;
  chosen.cells = guidePmf(all, powers, bins, guideWeight, chosen.defensiveWeight);
  return chosen;
}

}  // namespace importon
