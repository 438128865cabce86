/// What all passes of a run come to: where the next one goes on, and the statistics.
#pragma once
#include <span>

#include "render/photons/photon_system.h"
#include "render/surface_cache/surface_cache.h"

namespace importon {

class RunTotals {
 public:
  explicit RunTotals(PassContext& context) : context_(context) {}

  [[nodiscard]] const PassSums& done() const { return done_; }
  [[nodiscard]] PassSums& done() { return done_; }
  /// Adds pass `pass`, which the device is done with. Warns of what the device gave up.
  void countPass(int pass, const PhotonSystem& caustic, const PhotonSystem& global, const SurfaceCache& cache);
  /// Writes what is known at the end, after `passes` passes.
  void finish(int passes, const PhotonSystem& caustic, const PhotonSystem& global, const SurfaceCache& cache);
  void addKept(std::vector<Kept>& state);

 private:
  void addToDone(int pass);

  PassContext& context_;
  PassSums done_;
};

/// Of several devices that were at work on one image, as RenderStats says; of one its own. At least one.
[[nodiscard]] RenderStats sumOf(std::span<const RenderStats> ofDevices);

}  // namespace importon
