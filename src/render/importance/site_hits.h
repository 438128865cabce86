/// How many photon hits come to the places that the image reads, against how many the required density asks for there.
/// [Christensen 2003, shooting fewer photons]
#pragma once
#include <span>

#include "render/importance/importance.h"

namespace importon {

/// What some photons brought to the sites of an importance map. All sites stand for the same share of importance; their
/// counts are taken together by neighbourhoods that ask for several hits, since single ones scatter.
struct SiteSupply {
  double deficit = 0;  // mean, where light came, of what is missing, of 1, beyond what the scatter of counts explains
  double lit = 0;      // share of the sites in neighbourhoods that were hit
};

/// `hits`, and how many are asked for, of each site; `order` has the sites one next to the other.
[[nodiscard]] SiteSupply supplyOf(std::span<const uint> hits, std::span<const float> asked,
                                  std::span<const uint> order);

/// Decides after each batch of photons whether more are needed.
class ShootingRule {
 public:
  /// True once little is missing where light comes and the last batches lit hardly a new place; or if there is no site.
  [[nodiscard]] bool isEnough(const SiteSupply& supply);

 private:
  double lit_ = 0;
  int quiet_ = 0;  // batches since one lit new places
};

class SiteHits {
 public:
  /// Of the sites of `importance`, none hit yet.
  SiteHits(gpu::Context& context, MapKind kind, const ImportanceMap& importance, const Parameters& parameters);

  /// Counts the selected records of the workspace.
  void count(const Stage& stage) const;
  /// To be read in place of the importance map's own.
  [[nodiscard]] const gpu::Buffer& hits() const { return hits_; }
  /// By the hits so far of one pass, in a map that holds those of `passes`. Waits for the device.
  [[nodiscard]] SiteSupply supply(const Stage& stage, float passes) const;

 private:
  MapKind kind_;
  const ImportanceMap& importance_;
  std::vector<uint> order_;  // along a Z-order curve
  gpu::Buffer hits_, asked_;
};

}  // namespace importon
