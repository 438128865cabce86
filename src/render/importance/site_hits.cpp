#include "render/importance/site_hits.h"

#include <algorithm>
#include <cmath>

#include "render/importance/point_density.h"
#include "shared/bindings.h"
#include "shared/push_data.h"

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
  hits_ =
      gpu::makeBuffer(context, "site hits", std::span<const uint>(std::vector<uint>(sites)), gpu::TexelFormat::uint1);
  asked_ = gpu::Buffer(context, "site hits asked for", sites * sizeof(float));
  std::vector<std::pair<std::uint32_t, uint>> curve;
  for (const MapPoint& point : importance.readPoints())
    curve.emplace_back(zOrderCode(point.position, parameters.gridOrigin, parameters.gridExtent),
                       static_cast<uint>(curve.size()));
  std::sort(curve.begin(), curve.end());
  for (const auto& [code, site] : curve) order_.push_back(site);
}

void SiteHits::bind(gpu::BindingTable& table) const {
  table.set(kBindingImportonHits, hits_);
  table.set(kBindingImportonHitsOut, hits_);
}

void SiteHits::count(const Stage& stage) const {
  gpu::BindingTable table = stage.work.table;
  importance_.bind(table);
  bind(table);
  overItems(stage, stage.kernels.hitCount, table, kCounterSelected, HitCountPush{kind_ == MapKind::global, 1});
}

SiteSupply SiteHits::supply(const Stage& stage, float passes) const {
  const std::uint64_t sites = importance_.sites();
  if (sites == 0) return {};
  gpu::BindingTable table = stage.work.table;
  importance_.bind(table);
  table.set(kBindingWeightsOut, asked_);
  stage.recorder.dispatch(stage.kernels.siteAsk, table, static_cast<uint>(sites),
                          SiteAskPush{static_cast<uint>(sites), kind_ == MapKind::global});
  stage.recorder.submitAndWait();
  std::vector<float> asked = asked_.download<float>(sites);
  for (float& hits : asked) hits /= passes;
  return supplyOf(hits_.download<uint>(sites), asked, order_);
}

}  // namespace importon
