/// A scene on the device with all that its photon maps need, for tests that look into the maps.
#pragma once
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "render/device_scene/device_scene.h"
#include "render/guiding/emission_guide.h"
#include "render/importance/importance.h"
#include "render/photon_map/photon_map.h"
#include "render/photons/photon_pass.h"
#include "render/plan/pass_plan.h"
#include "render/surface_cache/surface_cells.h"

namespace importon::test {

/// The sites of an importance map: every kImportonsPerSite-th importon.
struct ImportonsFound {
  std::vector<MapPoint> points;
  std::vector<float> importance;  // pixels/m², at each
};

struct EmittedPhoton {
  vec3 direction;
  uint light;
  vec3 flux;  // W
};

/// Flux in surface cells, in whole units.
struct CellFlux {
  std::vector<std::array<std::uint64_t, 3>> sides;  // two of each cell
  bool isEnergyExact = false;                       // their sum is that of all hits, to the last bit
};

class MapRig {
 public:
  MapRig(gpu::Context& context, const Scene& scene, const RenderJob& job);

  Parameters parameters;  // may be changed between steps
  PassPlan plan;
  struct {
    ImportanceMap caustic, global;
  } importance;

  void findImportance();
  /// Has the sites of the caustic map in the global one: they lie where the camera looks. Importance must have been
  /// found.
  void seeGlobalMapDirectly();
  /// Gives each site of the global map the importance (pixels/m²) that `importance` says.
  void setImportance(const std::function<float(const vec3&)>& importance);
  [[nodiscard]] ImportonsFound importons(MapKind kind) const;
  /// Shoots the plan's photons into a map of `capacity` photons (0: the plan's).
  [[nodiscard]] PhotonMap shoot(MapKind kind, const StorageRule& rule,
                                std::uint64_t capacity = 0);  // finished for plan.nearestPhotons
  [[nodiscard]] PhotonMap shoot(MapKind kind, DensityControl control, uint receivers, std::uint64_t capacity = 0) {
    return shoot(kind, {control, receivers}, capacity);
  }
  /// Shoots the plan's photons into surface cells: of both sides of each, three channels of flux in whole units.
  [[nodiscard]] CellFlux shootIntoCells(const SurfaceCells& cells);
  /// Shoots them into a map that may have been used before.
  void shootInto(PhotonMap& map, MapKind kind, const StorageRule& rule);
  /// Precomputes irradiance of a finished map, at its photons or at the importons.
  void estimateIrradiance(PhotonMap& map, MapKind kind, bool atPhotons);
  /// For kernels of tests: the buffers that the renderer's kernels get, and what those are made for.
  template <class Call, class... Owners>
  [[nodiscard]] auto buffersOf(const Owners&... owners) const {
    return importon::buffersOf<Call>(*stage_, owners...);
  }
  [[nodiscard]] const FeatureSet& features() const { return features_; }
  /// A guide that a batch of photons has taught. Importance must have been found.
  [[nodiscard]] EmissionGuide trainedGuide(const Scene& scene, MapKind kind, int bins);
  /// A batch of photons as they leave the lights, by power or as a guide has it.
  [[nodiscard]] std::vector<EmittedPhoton> emit(MapKind kind, const EmissionGuide* guide = nullptr);
  /// Counts the hits of the plan's photons, with random numbers of their own.
  [[nodiscard]] ExpectedDensity countPilot(MapKind kind);
  [[nodiscard]] PhotonMapCounts counts(const PhotonMap& map) const {
    return map.readCounts(*stage_, parameters.fluxScale);
  }
  /// The photons of a finished map, render space.
  [[nodiscard]] std::vector<MapPoint> photons(const PhotonMap& map) const;
  /// In the order in which they were stored.
  [[nodiscard]] std::vector<MapPoint> photonsAsStored(const PhotonMap& map) const;
  /// Flux of `photons`, W, in their order.
  [[nodiscard]] std::vector<vec3> flux(const PhotonMap& map) const;
  /// kAovFloats of each pixel, with the finished global map.
  [[nodiscard]] std::vector<float> aovs(const PhotonMap& global);

 private:
  FeatureSet features_;
  gpu::Context& context_;
  std::optional<KernelSet> kernels_;
  DeviceScene deviceScene_;
  std::optional<Workspace> work_;
  std::optional<gpu::Recorder> recorder_;
  std::optional<Stage> stage_;
};

}  // namespace importon::test
