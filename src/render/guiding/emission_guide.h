/// With which probability photons leave which light in which direction, learned from what earlier ones brought to
/// places that the camera sees. [Peter and Pietrek 1998; Jensen 1995 for bins over the unit square of directions]
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "render/guiding/environment_guide.h"
#include "render/guiding/guide_pmf.h"
#include "render/importance/site_hits.h"
#include "scene/scene.h"

namespace importon {

/// A guide as photons follow it.
struct GuideBuffers {
  const gpu::Buffer &guideRows, &guideColumns, &environmentGuide;
};

class EmissionGuide {
 public:
  /// With up to `bins` x `bins` cells per light; fewer for many lights. It starts with startingPmf.
  EmissionGuide(gpu::Context& context, const Scene& scene, MapKind kind, int bins, GuideWeight weight);

  /// From now on a hit counts by what such hits leave missing of the required density, as counted from the selected
  /// records, of photons by power; a pass has `hitsPerPass` as many.
  void followDeficits(const Stage& stage, const ImportanceMap& importance, const Parameters& parameters,
                      float hitsPerPass);
  [[nodiscard]] const SiteHits* sites() const { return sites_ ? &*sites_ : nullptr; }
  [[nodiscard]] float hitsPerPass() const { return hitsPerPass_; }
  /// Records in the workspace, selected for the map, train the guide. `meanImportance`: pixels/m² of the scene.
  void train(const Stage& stage, const ImportanceMap& importance, float meanImportance);
  /// Makes new shares from all that was learned so far; the photons to come follow them. The device is idle.
  void update();
  /// Photons of the environment follow `guide` from now on, not the cells of its light, which count as one.
  void aimEnvironment(std::shared_ptr<const EnvironmentGuide> guide, std::size_t light);
  [[nodiscard]] bool aimsEnvironment() const { return environment_.guide != nullptr; }
  [[nodiscard]] GuideBuffers buffers(const StandIns& standIns) const {
    return {rows_, columns_, aimsEnvironment() ? environment_.guide->texels() : standIns.environmentGuide};
  }

  /// Purpose of the random stream: photons that follow new shares never repeat the numbers that trained it.
  [[nodiscard]] uint stream() const { return stream_; }
  [[nodiscard]] uint bins() const { return bins_; }
  [[nodiscard]] double gain() const { return gain_; }
  /// All that must last while a render pauses: the sums; `update` brings back the rest.
  [[nodiscard]] gpu::Buffer& memory() { return sums_; }

 private:
  struct Environment {
    std::shared_ptr<const EnvironmentGuide> guide;
    std::size_t light = 0;
  };

  void upload(std::vector<double> cells);

  MapKind kind_;
  uint bins_, stream_;
  std::vector<double> powers_;
  GuideWeight weight_;
  double gain_ = 1;
  std::optional<SiteHits> sites_;
  float hitsPerPass_ = 0;
  Environment environment_;
  gpu::Buffer rows_, columns_, sums_;
};

}  // namespace importon
