#include "render/importance/site_hits.h"

#include <algorithm>
#include <cmath>

#include "kernels/hit_count.h"
#include "kernels/site_ask.h"
#include "render/importance/point_density.h"

namespace importon {
namespace {

constexpr double kDeficitLeft = 0.05;  // that is borne
constexpr double kHitsTogether = 8;    // asked for by a neighbourhood
constexpr double kNewlyLit = 0.001;    // share of the sites: a batch that lit more found something new
constexpr int kQuietBatches = 3;

}  // namespace

SiteSupply supplyOf(std::span<const uint> hits, std::span<const float> asked, std::span<const uint> order) {
  SiteSupply supply;
  double lit = 0, missing = 0, sites = 0, count = 0, required = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    ++sites;
    count += static_cast<double>(hits[order[i]]);
    required += static_cast<double>(asked[order[i]]);
    if (required < kHitsTogether && i + 1 < order.size()) continue;
    if (count > 0) {
      lit += sites;
      missing += sites * std::max(0.0, 1 - (count + std::sqrt(count)) / required);
    }
    sites = count = required = 0;
  }
  if (lit > 0) supply.deficit = missing / lit;
  if (!order.empty()) supply.lit = lit / static_cast<double>(order.size());
  return supply;
}

bool ShootingRule::isEnough(const SiteSupply& supply) {
  quiet_ = supply.lit > lit_ + kNewlyLit ? 0 : quiet_ + 1;
  lit_ = supply.lit;
  return quiet_ >= kQuietBatches && supply.deficit < kDeficitLeft;
}

SiteHits::SiteHits(gpu::Context& context, MapKind kind, const ImportanceMap& importance, const Parameters& parameters)
    : kind_(kind), importance_(importance) {
  const std::uint64_t sites = std::max<std::uint64_t>(importance.sites(), 1);
  hits_ = gpu::makeZeros(context, "site hits", sites * sizeof(uint), gpu::TexelFormat::uint1);
  asked_ = gpu::Buffer(context, "site hits asked for", sites * sizeof(float));
  std::vector<std::pair<std::uint32_t, uint>> curve;
  for (const MapPoint& point : importance.readPoints())
    curve.emplace_back(zOrderCode(point.position, parameters.gridOrigin, parameters.gridExtent),
                       static_cast<uint>(curve.size()));
  std::sort(curve.begin(), curve.end());
  for (const auto& [code, site] : curve) order_.push_back(site);
}

void SiteHits::count(const Stage& stage) const {
  overItems<kernels::HitCount>(stage, kCounterSelected, {.isGlobal = kind_ == MapKind::global, .weight = 1},
                               buffers::ImportonHits{hits_}, importance_.buffers());
}

SiteSupply SiteHits::supply(const Stage& stage, float passes) const {
  const std::uint64_t sites = importance_.sites();
  if (sites == 0) return {};
  run<kernels::SiteAsk>(stage, sites, {.count = static_cast<uint>(sites), .isGlobal = kind_ == MapKind::global},
                        buffers::Asked{asked_}, importance_.buffers());
  stage.recorder.submitAndWait();
  std::vector<float> asked = asked_.download<float>(sites);
  for (float& hits : asked) hits /= passes;
  return supplyOf(hits_.download<uint>(sites), asked, order_);
}

}  // namespace importon
