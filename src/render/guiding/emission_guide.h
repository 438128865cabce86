/// With which probability photons leave which light in which direction, learned from what earlier ones brought to
/// places that the camera sees. [Peter and Pietrek 1998; Jensen 1995 for bins over the unit square of directions]
#pragma once
#include <optional>
#include <vector>

#include "render/guiding/guide_pmf.h"
#include "render/importance/site_hits.h"
#include "scene/scene.h"

namespace importon {

/// A guide as photons follow it.
struct GuideBuffers {
  const gpu::Buffer &guideRows, &guideColumns;
};

class EmissionGuide {
 public:
  /// With up to `bins` x `bins` cells per light; fewer for many lights. It starts with startingPmf.
  EmissionGuide(gpu::Context& context, const Scene& scene, MapKind kind, int bins, GuideWeight weight);

  /// From now on a hit counts by what such hits leave missing of the required density, as counted from the selected
  /// records, of photons by power; a pass has `hitsPerPass` as many.
  void followDeficits(const Stage& stage, const ImportanceMap& importance, const Parameters& parameters,
                      float hitsPerPass);
  /// Records in the workspace, selected for the map, train the guide. `meanImportance`: pixels/m² of the scene.
  void train(const Stage& stage, const ImportanceMap& importance, float meanImportance);
  /// Makes new shares from all that was learned so far; the photons to come follow them. The device is idle.
  void update();
  [[nodiscard]] GuideBuffers buffers() const { return {rows_, columns_}; }

  /// Purpose of the random stream: photons that follow new shares never repeat the numbers that trained it.
  [[nodiscard]] uint stream() const { return stream_; }
  [[nodiscard]] uint bins() const { return bins_; }
  [[nodiscard]] double gain() const { return gain_; }
  /// All that must last while a render pauses: the sums; `update` brings back the rest.
  [[nodiscard]] gpu::Buffer& memory() { return sums_; }

 private:
  void upload(const std::vector<double>& cells);

  MapKind kind_;
  uint bins_, stream_;
  std::vector<double> powers_;
  GuideWeight weight_;
  double gain_ = 1;
  std::optional<SiteHits> sites_;
  float hitsPerPass_ = 0;
  gpu::Buffer rows_, columns_, sums_;
};

}  // namespace importon
