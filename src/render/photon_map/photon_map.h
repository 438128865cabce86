/// A density-controlled photon map: stores hits while the density is below the required one, else hands their
/// power to photons that are there.
#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "render/photon_map/nearest_grid.h"
#include "render/photon_map/storage_rules.h"

namespace importon {

/// What became of the hits of a map in one pass.
struct PhotonMapCounts {
  std::uint64_t hits = 0, stored = 0, redistributed = 0, overflow = 0;
  std::array<double, 3> fluxHits{}, fluxMap{};  // W
  bool isEnergyExact =
      true;  // to the last bit of the fixed point: the two, or by probability what was kept and the map
};

class PhotonMap {
 public:
  /// For up to `capacity` stored photons. Room for them is made as they come.
  PhotonMap(gpu::Context& context, MapKind kind, std::uint64_t capacity);

  /// Empties the map for a new pass.
  void begin(const Stage& stage);
  /// Takes the batch of hits in the workspace's records. Waits for the device.
  void addBatch(const Stage& stage, const ImportanceMap& importance, const StorageRule& rule);
  /// Sorts the photons for lookups by radius; with `nearest` above 0, also for lookups of the so many nearest photons.
  /// Waits for the device where it makes room.
  void finish(const Stage& stage, const ImportanceMap& importance, uint nearest = 0);
  /// Precomputes irradiance at the photons of the finished map, or at the importons.
  void estimateIrradiance(const Stage& stage, const ImportanceMap& importance, bool atPhotons);

  /// False before the first pass: there is nothing to read.
  [[nodiscard]] bool isFinished() const { return static_cast<bool>(grid_.points); }
  /// Adds the finished map's light to the paths whose slots `slots` has, as many as the counter `source` counts; by
  /// precomputed irradiance or by the nearest photons if it has been finished so.
  void lookUp(const Stage& stage, const ImportanceMap& importance, uint source, const gpu::Buffer& slots) const;
  /// The finished map, for lookups by radius.
  [[nodiscard]] MapBuffers finished() const { return {SearchedGrid(grid_), mapFlux_}; }
  /// Number of the counter that has the finished map's grid levels.
  [[nodiscard]] uint levelsCounter() const { return photons_.counter(kMapLevels); }

  /// Hits that found no room, by the counters of the workspace.
  [[nodiscard]] uint overflow(std::span<const uint> counters) const { return counters[photons_.counter(kMapOverflow)]; }
  /// Reads what the pass counted, after the device is done with it.
  [[nodiscard]] PhotonMapCounts readCounts(const Stage& stage, float fluxScale) const;
  /// The photons of a finished map, render space, after the device is done with it.
  [[nodiscard]] std::vector<MapPoint> readPoints(const Stage& stage) const;
  /// Device memory of all that the map holds: photons, their flux and grid, the table of cells, the grids of batches
  /// and of lookups of the nearest, and irradiance.
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  StoredPhotons photons_;
  StorageByCells byCells_;
  StorageByQuota byQuota_;
  bool isThinned_ = false;
  PointGrid grid_;
  gpu::Buffer mapFlux_;  // in cell order
  std::optional<NearestGrid> nearest_;
  gpu::Buffer irradiance_;
  bool isIrradianceAtPhotons_ = false;
};

}  // namespace importon
