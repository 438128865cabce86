/// Which way photons scatter, learned from importance that was traced from the places that the image reads.
/// [Peter and Pietrek 1998]
#pragma once
#include <vector>

#include "render/importance/site_hits.h"
#include "render/render_job.h"

namespace importon {

/// A batch of importance that trains a guide.
struct ScatterBatch {
  std::uint32_t first = 0, count = 0;
  float meanImportance = 0;  // pixels/m²
  uint maxDepth = 0;
  const SiteHits* sites = nullptr;  // whose deficits matter; null: they do not
  float hitsPerPass = 0;            // for each hit that was counted there
};

/// What lib/scatter_guide.glsl reads of one cell: the share of guided samples, then the sums of its bins' shares up to
/// 1. Shares follow the smoothed `sums` (their root, unless it is potential: noise is least so if many places are lit
/// by single photons), evenly for as much as a cell of few importons does not know.
[[nodiscard]] std::vector<float> scatterCellOf(std::span<const double> sums, GuideWeight guideWeight);

class ScatterGuide {
 public:
  /// Over the box of the scene that `parameters` has; nothing is guided until it has learned.
  ScatterGuide(gpu::Context& context, const Parameters& parameters, GuideWeight weight);

  /// The selected records, of importance, train the guide.
  void train(const Stage& stage) const;
  /// Makes shares of all that was learned. The device is idle.
  void update();
  [[nodiscard]] const gpu::Buffer& cells() const { return cells_; }
  [[nodiscard]] bool isPotential() const { return weight_ == GuideWeight::potential; }
  [[nodiscard]] const ScatterGrid& grid() const { return grid_; }

 private:
  ScatterGrid grid_;
  GuideWeight weight_;
  gpu::Buffer sums_, cells_;
};

}  // namespace importon
