/// A density-controlled photon map: stores hits while the density is below the required one, else hands their
/// power to photons that are there.
#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "render/expected_density.h"
#include "render/storage_rule.h"
#include "shared/push_data.h"

namespace importon {

/// What became of the hits of a map in one pass.
struct PhotonMapCounts {
  std::uint64_t hits = 0, stored = 0, redistributed = 0, overflow = 0;
  std::array<double, 3> fluxHits{}, fluxMap{};  // W
  bool isEnergyExact = true;  // to the last bit of the fixed point: the two, or by probability what was kept and the map
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
  /// True if the finished map is read by the nearest photons.
  [[nodiscard]] bool isReadByNearest() const { return nearest_.has_value(); }
  [[nodiscard]] MapNearestPush nearestPush(uint source) const;
  /// Precomputes irradiance at the photons of the finished map, or at the importons.
  void estimateIrradiance(const Stage& stage, const ImportanceMap& importance, bool atPhotons);
  [[nodiscard]] bool hasIrradiance() const { return irradiance_.bytes() > 0; }
  /// Binds the finished map and its irradiance for map_irradiance.
  void bindIrradiance(gpu::BindingTable& table) const;
  [[nodiscard]] MapIrradiancePush irradiancePush(uint source) const;
  /// Binds the finished map for map_nearest.
  void bindNearest(gpu::BindingTable& table) const;
  /// Number of the counter that has the finished map's grid levels.
  [[nodiscard]] uint levelsCounter() const { return counter(kMapLevels); }
  /// Binds the finished map for map_lookup.
  void bindFinished(gpu::BindingTable& table) const;
  /// Hits that found no room, by the counters of the workspace.
  [[nodiscard]] uint overflow(std::span<const uint> counters) const { return counters[counter(kMapOverflow)]; }
  /// Reads what the pass counted, after the device is done with it.
  [[nodiscard]] PhotonMapCounts readCounts(const Stage& stage, float fluxScale) const;
  /// The photons of a finished map, render space, after the device is done with it.
  [[nodiscard]] std::vector<MapPoint> readPoints(const Stage& stage) const;
  /// Device memory of all that the map holds: photons, their flux and grid, the table of cells, the grids of batches and
  /// of lookups of the nearest, and irradiance.
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  void store(const Stage& stage, gpu::BindingTable& table, bool isWeighted = false);
  void makeRoom(const Stage& stage, std::uint64_t photons);
  void makeRoomForCells(const Stage& stage, std::uint64_t cells);
  void makeRoomForBatch(const Stage& stage);
  void countStored(const Stage& stage) const;
  void controlByCells(const Stage& stage, gpu::BindingTable& table);
  void controlByProbability(const Stage& stage, gpu::BindingTable& table, const StorageRule& rule);
  void controlByQuota(const Stage& stage, gpu::BindingTable& table, const ImportanceMap& importance, const StorageRule& rule);
  void buildStoredGrid(const Stage& stage, const ImportanceMap& importance, bool isFinished);
  [[nodiscard]] uint counter(uint which) const;

  /// Every photon at each of `levels`, so that a search for the nearest finds them at any density.
  struct NearestGrid {
    PointGrid grid;
    gpu::Buffer flux;
    uint levels = 0, photons = 0;
  };
  void buildNearestGrid(const Stage& stage, uint nearest);

  MapKind kind_;
  std::uint64_t capacity_;
  std::uint64_t photons_ = 0;  // stored so far
  std::optional<NearestGrid> nearest_;
  gpu::Buffer irradiance_;
  bool isIrradianceAtPhotons_ = false;
  bool hasStored_ = false, isThinned_ = false;
  gpu::Buffer points_, flux_, mapFlux_, totals_, cells_;
  PointGrid stored_, batch_;
};

}  // namespace importon
