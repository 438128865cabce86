/// One of the two photon maps with all that decides what it stores: importance, guides, control.
#pragma once
#include <functional>
#include <optional>

#include "render/device/pass_context.h"
#include "render/photon_map/photon_map.h"
#include "render/photons/photon_pass.h"

namespace importon {

struct PhotonSystem {
  PhotonSystem(PassContext& context, MapKind kind);

  MapKind kind;
  bool isUsed;                              // the scene asks for its photons
  ImportanceMap importance;                 // from which required density follows
  std::optional<EmissionGuide> emission;    // none: by power
  std::optional<ScatterGuide> scatter;      // none: by materials alone
  std::optional<ExpectedDensity> expected;  // for storage by probability
  std::optional<PhotonMap> map;             // none where surface cells hold the photons
  DensityControl control;                   // stricter than the job's where memory lacks

  /// Photons by the guides. `isPilot`: in no map, with random numbers of their own.
  [[nodiscard]] PhotonSource source(bool isPilot) const;
  [[nodiscard]] StorageRule storageRule(const PassPlan& plan) const;

  /// Shoots the photons of the pass at hand into the map, batch by batch; in the first passes they train the guide too.
  /// `addBatch`, if any, sees each batch. `isFirst`: not yet done in this pass, with a map that was too small.
  void shoot(PassContext& context, bool isFirst, const std::function<void()>& addBatch);
  /// Has the guide follow all that it learned, after a pass in which it learned.
  void endPass(const PassContext& context);

  /// True if hits found no room, by the counters of the workspace.
  [[nodiscard]] bool isFull(std::span<const uint> counters) const { return map && map->overflow(counters) > 0; }
  /// Device memory of the map and of what decides storage.
  [[nodiscard]] std::uint64_t bytes() const;
  void addKept(std::vector<Kept>& state, Parameters& parameters);
  /// Makes what follows from the state that was taken up.
  void restored(int passes);
};

/// Lowers the required density of both maps so that they fit in memory; warns. Throws DeviceError where nothing fits.
void tightenDensityLimit(PassContext& context, PhotonSystem& caustic, PhotonSystem& global);

}  // namespace importon
