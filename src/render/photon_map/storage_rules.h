/// The ways to decide which of a batch's selected hits are stored, and where the power of the others goes.
#pragma once
#include "render/photon_map/expected_density.h"
#include "render/photon_map/stored_photons.h"
#include "render/plan/storage_rule.h"

namespace importon {

/// The first hit of each cell is stored; the power of the others goes to it: shaders/lib/photon_cell.glsl.
class StorageByCells {
 public:
  void clear(const Stage& stage);
  void control(const Stage& stage, StoredPhotons& photons, const ImportanceMap& importance);
  [[nodiscard]] std::uint64_t bytes() const { return cells_.allocatedBytes(); }

 private:
  void makeRoom(const Stage& stage, std::uint64_t cells, const StoredPhotons& photons);

  gpu::Buffer cells_;  // a hash table of PhotonCell
};

/// Hits near which fewer than the quota fell before them are stored; the power of the others goes to the nearest
/// photons, those of the batch among them. [Suykens and Willems 2000]
class StorageByQuota {
 public:
  void clear() { hasStored_ = isGridOld_ = false; }
  /// `grid`: of the photons that are stored.
  void control(const Stage& stage, StoredPhotons& photons, PointGrid& grid, const ImportanceMap& importance,
               const StorageRule& rule);
  [[nodiscard]] std::uint64_t bytes() const { return batch_.bytes(); }

 private:
  bool hasStored_ = false;
  bool isGridOld_ = false;  // photons were stored since it was made
  PointGrid batch_;
};

/// Each hit is stored with the probability that brings the density expected of them to the required one, and with as
/// much more power. [Keller and Wald 2000]
void storeByProbability(const Stage& stage, StoredPhotons& photons, const ImportanceMap& importance,
                        const StorageRule& rule);

/// All hits are stored.
void storeAll(const Stage& stage, StoredPhotons& photons, const ImportanceMap& importance);

}  // namespace importon
