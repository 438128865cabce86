#include "render/guiding/scatter_guide.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kernels/scatter_learn.h"
#include "render/guiding/guide_pmf.h"

namespace importon {
namespace {

constexpr double kGuidedShare = 0.75;  // of light from cosine lobes; the rest goes as the material has it
constexpr double kUnsure = 16;         // importons' worth of even shares in each cell
constexpr double kMostVoxels = 1u << 14;
constexpr std::size_t kBins = std::size_t{kScatterBins} * kScatterBins;

ScatterGrid gridOver(const Parameters& p) {
  const vec3 sides = glm::max(2.0f * (p.sceneCentre - p.gridOrigin), vec3(1e-3f * p.gridExtent));
  const double edge = std::cbrt(static_cast<double>(sides.x) * sides.y * sides.z / kMostVoxels);
  return {p.gridOrigin, static_cast<float>(1 / edge), uvec3(glm::ceil(sides / static_cast<float>(edge)))};
}

std::size_t cellsOf(const ScatterGrid& grid) {
  return std::size_t{grid.voxels.x} * grid.voxels.y * grid.voxels.z * kScatterFacings;
}

}  // namespace

std::vector<float> scatterCellOf(std::span<const double> sums, GuideWeight guideWeight) {
  std::vector<float> cell(kBins + 1);
  const double learned = std::accumulate(sums.begin(), sums.end(), 0.0);
  if (learned <= 0) return cell;
  std::vector<double> weights = smoothBins({sums.begin(), sums.end()}, 1, kScatterBins);
  if (guideWeight != GuideWeight::potential)
    for (double& weight : weights) weight = std::sqrt(weight);
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double known = learned / (learned + kUnsure * kGuideUnits);
  double sum = 0;
  cell[0] = kGuidedShare;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    sum += known * weights[bin] / total + (1 - known) / static_cast<double>(kBins);
    cell[bin + 1] = static_cast<float>(std::min(sum, 1.0));
  }
  cell[kBins] = 1;
  return cell;
}

ScatterGuide::ScatterGuide(gpu::Context& context, const Parameters& parameters, GuideWeight weight)
    : grid_(gridOver(parameters)), weight_(weight) {
  const std::size_t cells = cellsOf(grid_);
  sums_ = gpu::makeZeros(context, "scatter guide sums", cells * kBins * sizeof(uint));
  cells_ = gpu::makeZeros(context, "scatter guide", cells * (kBins + 1) * sizeof(float), gpu::TexelFormat::float1);
}

void ScatterGuide::train(const Stage& stage) const {
  overItems<kernels::ScatterLearn>(stage, kCounterSelected, {.guide = grid_}, buffers::ScatterSums{sums_});
}

void ScatterGuide::update() {
  const std::size_t cells = cellsOf(grid_);
  const auto sums = sums_.download<uint>(cells * kBins);
  std::vector<float> all;
  all.reserve(cells * (kBins + 1));
  for (std::size_t first = 0; first < sums.size(); first += kBins) {
    const std::vector<double> own(sums.begin() + static_cast<std::ptrdiff_t>(first),
                                  sums.begin() + static_cast<std::ptrdiff_t>(first + kBins));
    const std::vector<float> cell = scatterCellOf(own, weight_);
    all.insert(all.end(), cell.begin(), cell.end());
  }
  cells_.upload(std::span<const float>(all));
}

}  // namespace importon
