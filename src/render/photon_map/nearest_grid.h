/// The photons of a map in a grid in which the nearest ones are found at any density.
#pragma once
#include <vector>

#include "render/photon_map/stored_photons.h"

namespace importon {

/// Every photon stands at each of some levels.
class NearestGrid {
 public:
  /// Of all photons that kCounterStored counts, for lookups of the `nearest` ones. Waits for the device.
  NearestGrid(const Stage& stage, const StoredPhotons& photons, uint nearest);
  /// Levels to look at one after the other, a bit each, the finest first: so many at a time as leave each time enough
  /// photons to a lookup (lib/nearest.glsl). Each turn begins where the one before ended.
  [[nodiscard]] std::vector<uint> levelsInTurn() const;
  [[nodiscard]] uint nearest() const { return nearest_; }
  [[nodiscard]] MapBuffers buffers() const { return {SearchedGrid(grid_), flux_}; }
  [[nodiscard]] std::uint64_t bytes() const { return grid_.bytes() + flux_.allocatedBytes(); }

 private:
  uint levels_ = 0, nearest_;
  PointGrid grid_;
  gpu::Buffer flux_;
};

}  // namespace importon
