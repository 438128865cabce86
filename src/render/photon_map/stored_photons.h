/// Photons as they were stored, with their flux in fixed point: shaders/bindings/photons.glsl.
#pragma once
#include <span>

#include "render/importance/importance.h"

namespace importon {

/// Photons in a grid as lookups read them.
struct MapBuffers : SearchedGrid {
  MapBuffers(const SearchedGrid& grid, const gpu::Buffer& flux) : SearchedGrid(grid), mapFlux(flux) {}
  const gpu::Buffer& mapFlux;  // or irradiance, by photon
};

/// Photons as hits are added to them.
struct PhotonBuffers {
  const gpu::Buffer &photonPoints, &photonFlux, &totals;
};

class StoredPhotons {
 public:
  /// For up to `capacity` photons. Room for them is made as they come.
  StoredPhotons(gpu::Context& context, MapKind kind, std::uint64_t capacity);

  void clear(const Stage& stage);
  [[nodiscard]] PhotonBuffers buffers() const { return {points_, flux_, totals_}; }
  /// Stores the selected hits that work.keep marks; with the weights of work.required if `isWeighted`. Waits for the
  /// device.
  void store(const Stage& stage, bool isWeighted = false);
  /// Adds those that were stored last to kCounterStored.
  void countStored(const Stage& stage) const;
  /// Sorts them into a grid by the levels that they have while the map grows, or in the finished map.
  void sortInto(const Stage& stage, PointGrid& grid, const ImportanceMap& importance, bool isFinished) const;

  [[nodiscard]] MapKind kind() const { return kind_; }
  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] std::uint64_t capacity() const { return capacity_; }
  /// Number of one of the map's own counters, kMap*.
  [[nodiscard]] uint counter(uint which) const;
  [[nodiscard]] const gpu::Buffer& points() const { return points_; }
  [[nodiscard]] const gpu::Buffer& totals() const { return totals_; }  // FluxTotals
  [[nodiscard]] std::uint64_t bytes() const {
    return points_.allocatedBytes() + flux_.allocatedBytes() + totals_.allocatedBytes();
  }

 private:
  void makeRoom(const Stage& stage, std::uint64_t photons);

  MapKind kind_;
  std::uint64_t capacity_, count_ = 0;
  gpu::Buffer points_, flux_, totals_;
};

/// A grid that has room for `points`, made anew if it has not.
void makeRoomIn(const Stage& stage, PointGrid& grid, const char* name, std::uint64_t points, std::uint64_t most);

}  // namespace importon
