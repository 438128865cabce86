#include "render/emission_guide.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "shared/bindings.h"
#include "shared/push_data.h"

namespace importon {
namespace {

constexpr double kPlainShare = 0.15;             // by power, whatever was learned
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

std::vector<double> smoothBins(const std::vector<double>& moments, std::size_t lights, int bins) {
  std::vector<double> out(moments.size());
  const std::size_t perLight = static_cast<std::size_t>(bins) * static_cast<std::size_t>(bins);
  for (std::size_t light = 0; light < lights; ++light) {
    for (int y = 0; y < bins; ++y) {
      for (int x = 0; x < bins; ++x) {
        double sum = 0;
        for (int qy = std::max(y - 1, 0); qy <= std::min(y + 1, bins - 1); ++qy)
          for (int qx = std::max(x - 1, 0); qx <= std::min(x + 1, bins - 1); ++qx)
            sum += moments[light * perLight + static_cast<std::size_t>(qy * bins + qx)] * (qx == x && qy == y ? 8 : 1);
        out[light * perLight + static_cast<std::size_t>(y * bins + x)] = sum / 16;
      }
    }
  }
  return out;
}

GuideShares shareOut(const std::vector<double>& moments, const std::vector<double>& powers, int bins,
                     GuideWeight guideWeight) {
  const std::size_t perLight = moments.size() / powers.size();
  const std::vector<double> smoothed = smoothBins(moments, powers.size(), bins);
  double total = 0;
  const auto weight = [&](double moment) { return guideWeight == GuideWeight::potential ? moment : std::sqrt(moment); };
  for (const double moment : smoothed) total += weight(moment);
  GuideShares shares;
  double byPower = 0, byGuide = 0;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const double power = powers[i / perLight] / static_cast<double>(perLight);
    const double even = 1 / static_cast<double>(moments.size());
    const double plain = 0.5 * (power + even);
    // Where nothing is learned yet, each cell keeps some photons beside those of much stronger lights.
    const double share = total > 0 ? kPlainShare * plain + (1 - kPlainShare) * weight(smoothed[i]) / total
                                   : kPlainShare * plain + (1 - kPlainShare) * power;
    shares.cells.push_back(share);
    if (moments[i] <= 0) continue;
    byPower += moments[i] / std::max(power, 1e-300);
    byGuide += moments[i] / share;
  }
  if (byGuide > 0) shares.gain = byPower / byGuide;
  return shares;
}

EmissionGuide::EmissionGuide(gpu::Context& context, const Scene& scene, MapKind kind, int bins, GuideWeight weight)
    : kind_(kind),
      bins_(chooseBins(scene.lights.size(), bins)),
      stream_(kind == MapKind::global ? kStreamGlobalPhotons : kStreamCausticPhotons),
      powers_(powersOf(scene)),
      weight_(weight) {
  const std::uint64_t rows = scene.lights.size() * bins_;
  rows_ = gpu::Buffer(context, "guide rows", (rows + 1) * sizeof(float), gpu::TexelFormat::float1);
  columns_ = gpu::Buffer(context, "guide columns", rows * (bins_ + 1) * sizeof(float), gpu::TexelFormat::float1);
  sums_ = gpu::Buffer(context, "guide sums", rows * bins_ * sizeof(uint));
  sums_.upload(std::span<const uint>(std::vector<uint>(rows * bins_)));
  upload(shareOut(std::vector<double>(rows * bins_), powers_, static_cast<int>(bins_), weight_).cells);
}

void EmissionGuide::followDeficits(const Stage& stage, const ImportanceMap& importance, const Parameters& parameters,
                                   float hitsPerPass) {
  sites_.emplace(stage.gpu, kind_, importance, parameters);
  sites_->count(stage);
  hitsPerPass_ = hitsPerPass;
}

void EmissionGuide::learn(const Stage& stage, const ImportanceMap& importance, float meanImportance) {
  gpu::BindingTable table = stage.work.table;
  importance.bind(table);
  if (sites_) sites_->bind(table);
  bind(table);
  table.set(kBindingGuideSums, sums_);
  overItems(stage, stage.kernels.guideLearn, table, kCounterSelected,
            GuideLearnPush{kind_ == MapKind::global, stream_, bins_, meanImportance, hitsPerPass_,
                           weight_ == GuideWeight::potential});
}

void EmissionGuide::update() {
  const auto sums = sums_.download<uint>(powers_.size() * bins_ * bins_);
  const GuideShares shares = shareOut({sums.begin(), sums.end()}, powers_, static_cast<int>(bins_), weight_);
  upload(shares.cells);
  gain_ = shares.gain;
  ++stream_;
}

void EmissionGuide::upload(const std::vector<double>& cells) {
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

void EmissionGuide::bind(gpu::BindingTable& table) const {
  table.set(kBindingGuideRows, rows_);
  table.set(kBindingGuideColumns, columns_);
}

}  // namespace importon
