/// Irradiance cached on surfaces in place of the global map: where its cells are, how large, and what they hold.
#pragma once
#include <optional>

#include "render/importance/point_density.h"
#include "render/photons/photon_system.h"
#include "render/surface_cache/irradiance_map.h"

namespace importon {

class SurfaceCache {
 public:
  explicit SurfaceCache(PassContext& context) : context_(context) {}

  /// Sizes of cells follow importance: that of the importons in the workspace's records.
  void learnImportance();
  /// They follow the hits of a pass too: shoots a few photons to see where they fall.
  void learnHits();
  [[nodiscard]] bool isUsed() const { return hits_.has_value(); }
  /// False before the first pass.
  [[nodiscard]] bool hasCells() const { return irradiance_.has_value(); }

  /// Cuts the cells anew where pass `pass` asks for it; sets the parameters of the pass and binds what it needs.
  void beginPass(int pass);
  /// Adds the batch of hits in the workspace's records.
  void addBatch() { irradiance_->addBatch(context_.stage()); }
  /// Makes what gather rays read.
  void smooth() { irradiance_->smooth(context_.stage()); }
  /// The photons of pass `pass`, and of all before it, are in.
  void endPass(int pass) { irradiance_->setPasses(pass + 1); }
  /// What a pass counted, from the counters of the workspace.
  void count(std::span<const uint> counters, PhotonMapStats& stats) const;
  /// Flux of an average pass.
  [[nodiscard]] PhotonMapCounts readFlux() const { return irradiance_->readFlux(); }
  [[nodiscard]] std::uint64_t bytes() const { return irradiance_ ? irradiance_->bytes() : 0; }

  /// Has the cells that there are after `passes` passes, for what addKept() says to be taken up.
  void prepareFor(int passes);
  void addKept(std::vector<Kept>& state);

 private:
  [[nodiscard]] PointDensity densityOfRecords(float scale, bool isFlux) const;
  void cut(int generation);

  PassContext& context_;
  std::optional<PointDensity> importance_;  // pixels/m²
  std::optional<PointDensity> hits_;        // of a pass, per m²
  std::optional<IrradianceMap> irradiance_;
};

}  // namespace importon
