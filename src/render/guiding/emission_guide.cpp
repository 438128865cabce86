#include "render/guiding/emission_guide.h"

#include <algorithm>
#include <numeric>

#include "kernels/guide_learn.h"

namespace importon {
namespace {

constexpr std::size_t kMostCells = 1u << 18;

std::vector<double> powersOf(const Scene& scene) {
  std::vector<double> powers;
  for (const Light& light : scene.lights) powers.push_back(light.power);
  const double sum = std::accumulate(powers.begin(), powers.end(), 0.0);
  for (double& power : powers) power /= sum;
  return powers;
}

uint chooseBins(std::size_t lights, int most) {
  int bins = most;
  while (bins > 1 && lights * static_cast<std::size_t>(bins) * static_cast<std::size_t>(bins) > kMostCells) bins /= 2;
  return static_cast<uint>(bins);
}

/// Shares summed up from 0; the last is 1.
void sumUp(std::span<const double> shares, double total, std::vector<float>& out) {
  double sum = 0;
  out.push_back(0);
  for (const double share : shares) {
    sum += share;
    out.push_back(static_cast<float>(std::min(sum / total, 1.0)));
  }
  out.back() = 1;
}

}  // namespace

EmissionGuide::EmissionGuide(gpu::Context& context, const Scene& scene, MapKind kind, int bins, GuideWeight weight)
    : kind_(kind),
      bins_(chooseBins(scene.lights.size(), bins)),
      stream_(traitsOf(kind).randomStream),
      powers_(powersOf(scene)),
      weight_(weight) {
  const std::uint64_t rows = scene.lights.size() * bins_;
  rows_ = gpu::Buffer(context, "guide rows", (rows + 1) * sizeof(float), gpu::TexelFormat::float1);
  columns_ = gpu::Buffer(context, "guide columns", rows * (bins_ + 1) * sizeof(float), gpu::TexelFormat::float1);
  const std::uint64_t cells = rows * bins_;
  sums_ = gpu::makeZeros(context, "guide sums", 4 * cells * sizeof(uint));
  upload(startingPmf(powers_, std::size_t{bins_} * bins_));
}

void EmissionGuide::followDeficits(const Stage& stage, const ImportanceMap& importance, const Parameters& parameters,
                                   float hitsPerPass) {
  sites_.emplace(stage.gpu, kind_, importance, parameters);
  sites_->count(stage);
  hitsPerPass_ = hitsPerPass;
}

void EmissionGuide::train(const Stage& stage, const ImportanceMap& importance, float meanImportance) {
  const kernels::GuideLearn::Push push{.isGlobal = kind_ == MapKind::global,
                                       .stream = stream_,
                                       .bins = bins_,
                                       .meanImportance = meanImportance,
                                       .hitsPerPass = hitsPerPass_,
                                       .isPotential = weight_ == GuideWeight::potential};
  const gpu::Buffer& hits = sites_ ? sites_->hits() : importance.hits;
  overItems<kernels::GuideLearn>(stage, kCounterSelected, push, importon::buffers::ImportonHits{hits},
                                 importance.buffers(), buffers(stage.work.standIns),
                                 importon::buffers::GuideSums{sums_});
}

void EmissionGuide::update() {
  const std::size_t cells = powers_.size() * bins_ * bins_;
  const auto momentsAt = [&](std::size_t first) {
    std::vector<double> moments;
    for (const std::uint64_t units : sums_.download<std::uint64_t>(cells, first * sizeof(std::uint64_t)))
      moments.push_back(static_cast<double>(units) / kMomentUnits);
    return moments;
  };
  const GuidePmf shares = chooseGuidePmf(momentsAt(0), momentsAt(cells), powers_, static_cast<int>(bins_), weight_);
  upload(shares.cells);
  gain_ = shares.gain;
  ++stream_;
}

void EmissionGuide::aimEnvironment(std::shared_ptr<const EnvironmentGuide> guide, std::size_t light) {
  environment_ = {std::move(guide), light};
}

void EmissionGuide::upload(std::vector<double> cells) {
  if (aimsEnvironment()) {
    const std::span own = std::span(cells).subspan(environment_.light * bins_ * bins_, std::size_t{bins_} * bins_);
    std::ranges::fill(own, std::accumulate(own.begin(), own.end(), 0.0) / static_cast<double>(own.size()));
  }
  std::vector<double> rowShares;
  std::vector<float> rows, columns;
  for (std::size_t first = 0; first < cells.size(); first += bins_) {
    const std::span<const double> row(cells.data() + first, bins_);
    rowShares.push_back(std::accumulate(row.begin(), row.end(), 0.0));
    sumUp(row, rowShares.back(), columns);
  }
  sumUp(rowShares, std::accumulate(rowShares.begin(), rowShares.end(), 0.0), rows);
  rows_.upload(std::span<const float>(rows));
  columns_.upload(std::span<const float>(columns));
}

}  // namespace importon
