/// A density-controlled photon map: stores hits while the density is below the required one, else hands their
/// power to photons that are there.
#pragma once
#include <array>
#include <span>

#include "render/expected_density.h"
#include "render/render_job.h"

namespace importon {

/// What became of the hits of a map in one pass.
struct PhotonMapCounts {
  std::uint64_t hits = 0, stored = 0, redistributed = 0, overflow = 0;
  std::array<double, 3> fluxHits{}, fluxMap{};  // W
  bool isEnergyExact = true;  // to the last bit of the fixed point: the two, or by probability what was kept and the map
};

/// How a map decides which hits it stores.
struct StorageRule {
  DensityControl control = DensityControl::density;
  uint receivers = 0;  // M' nearest photons that share the power of a rejected hit, by the rank quota; 0: that of its cell
  const ExpectedDensity* expected = nullptr;  // for control by probability
  float probabilityFloor = 0;
};

class PhotonMap {
 public:
  /// For up to `capacity` stored photons, from batches of up to `batchHits` hits.
  PhotonMap(gpu::Context& context, MapKind kind, std::uint64_t capacity, std::uint64_t batchHits);

  /// Empties the map for a new pass.
  void begin(const Stage& stage);
  /// Takes the batch of hits in the workspace's records.
  void addBatch(const Stage& stage, const ImportanceMap& importance, const StorageRule& rule);
  /// Sorts the photons for lookups.
  void finish(const Stage& stage, const ImportanceMap& importance);
  /// Number of the counter that has the finished map's grid levels.
  [[nodiscard]] uint levelsCounter() const { return counter(kMapLevels); }
  /// Binds the finished map for map_lookup.
  void bindFinished(gpu::BindingTable& table) const;
  /// Hits that found no room, by the counters of the workspace.
  [[nodiscard]] uint overflow(std::span<const uint> counters) const { return counters[counter(kMapOverflow)]; }
  /// Reads what the pass counted, after the device is done with it.
  [[nodiscard]] PhotonMapCounts readCounts(const Stage& stage, float fluxScale) const;
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  void store(const Stage& stage, gpu::BindingTable& table, bool isWeighted = false) const;
  void countStored(const Stage& stage) const;
  void controlByCells(const Stage& stage, gpu::BindingTable& table);
  void controlByProbability(const Stage& stage, gpu::BindingTable& table, const StorageRule& rule);
  void controlByQuota(const Stage& stage, gpu::BindingTable& table, const ImportanceMap& importance, uint receivers);
  void buildStoredGrid(const Stage& stage, const ImportanceMap& importance, bool isFinished);
  [[nodiscard]] uint counter(uint which) const;

  MapKind kind_;
  std::uint64_t capacity_;
  bool hasStored_ = false, hasCells_ = false, isThinned_ = false;
  gpu::Buffer points_, flux_, mapFlux_, totals_, cells_, slots_;
  PointGrid stored_, batch_;
};

}  // namespace importon
