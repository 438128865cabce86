/// A render in progress: device, scene, maps and film, with the named phases that renderer.cpp runs.
#pragma once
#include <chrono>
#include <memory>
#include <optional>

#include "base/log.h"
#include "render/photon_pass.h"
#include "render/checkpoint.h"
#include "render/device_scene.h"
#include "render/eye_pass.h"
#include "render/film.h"
#include "render/irradiance_map.h"
#include "render/light_share.h"
#include "render/loaded_device.h"
#include "render/pass_plan.h"
#include "render/point_density.h"
#include "render/renderer.h"

namespace importon {

/// Sums over the passes so far.
struct PassSums {
  std::uint64_t evenSamples = 0, oddSamples = 0;  // per pixel
  std::uint64_t photons = 0, causticPhotons = 0;
  std::uint64_t photonsCounted = 0, causticCounted = 0;  // whose hits are counted near importons, the pilot's too
};

class RenderSession {
 public:
  RenderSession(const RenderJob& job, const Scene& scene, Log& log, const DeviceSource& deviceSource = loadDevice);

  /// Importons, importance maps, required density.
  void findImportance();
  /// Photons of pass `pass`, of `parts` of kPartsOfPass parts, into density-controlled maps.
  void shootPhotons(int pass, int parts);
  /// Camera paths of pass `pass`, reading the maps, into the film.
  void gatherImage(int pass);
  /// Reads what the pass counted.
  void countPass(int pass);

  /// The state after `passes` passes, with what else the caller has to keep.
  [[nodiscard]] Checkpoint save(int passes, std::vector<CheckpointBlock> more);
  /// Reads the job's checkpoint. SceneError where it is unreadable or of another run.
  [[nodiscard]] Checkpoint readCheckpointOfJob() const;
  /// Goes on from there. Importance must have been found.
  void restore(const Checkpoint& checkpoint);

  [[nodiscard]] int maxPasses() const { return plan_.maxPasses; }
  [[nodiscard]] bool hasMaps() const { return job_.integrator == Integrator::photon; }
  [[nodiscard]] double estimatedError() const { return readFilm().estimatedError; }
  /// The image so far with the layers that the job asks for.
  [[nodiscard]] Image resolve();
  /// The same without AOVs.
  [[nodiscard]] Image resolveColor() const;
  [[nodiscard]] std::uint64_t pixels() const { return static_cast<std::uint64_t>(size_.x) * static_cast<std::uint64_t>(size_.y); }
  /// As if the passes so far had come to this: tests skip days so.
  void setDone(const PassSums& done) { done_ = done; }
  [[nodiscard]] RenderStats& stats() { return stats_; }
  void finishStats(int passes);

 private:
  /// Memory of the device that lasts from pass to pass, by name: what a checkpoint must hold.
  struct Lasting {
    std::string name;
    gpu::Buffer* buffer;
  };
  [[nodiscard]] std::vector<Lasting> lastingMemory();
  [[nodiscard]] std::uint64_t runFingerprint() const;
  [[nodiscard]] FilmLayers readFilm() const;
  void startPass(int pass);
  void setPhotons(MapSettings& map, std::uint32_t perPass, std::uint64_t before, std::uint64_t counted) const;
  void uploadParameters();
  /// What the sizes of surface cells follow: importance, pixels/m², and the photon hits of a pass per m².
  struct CellSizes {
    PointDensity importance;
    std::optional<PointDensity> hits;
  };
  /// How densely the records for the global map lie: each counts `scale`, or as many times its flux.
  [[nodiscard]] PointDensity densityOfRecords(float scale, bool isFlux) const;
  /// Shoots a few photons to see where they fall.
  void findCellSizes();
  void cutCells(int generation);
  /// Has the irradiance map ready for a pass.
  void prepareCells(int pass);
  /// Fills what holds the pass's photons of a kind, batch by batch, and teaches their guide. `isFirst`: not yet done in
  /// this pass, with a map that was too small.
  void shootFor(MapKind kind, bool isFirst);
  /// Lowers the required density of the caustic map where other light drowns the caustic, as a pilot finds.
  void knowOtherLight();
  void addPilotLight(MapKind kind, std::vector<LightPoint>& light);
  /// Chooses how many photons the lookups of a map have, if the job asks for it.
  void chooseLookups(MapKind kind, MapSettings& settings);
  /// Fills a map with a pass's photons that are in no other; a second time, with others.
  void shootTrialMap(MapKind kind, MapSettings& settings, bool isSecond);
  /// Radiance of a finished map where the camera looks: three channels of each pixel.
  [[nodiscard]] std::vector<float> seeMap(MapKind kind);
  /// Traces importance from where the image reads the global map, which teaches photons which way to scatter.
  void trainScatter();
  [[nodiscard]] PhotonSource sourceOf(MapKind kind, bool isPilot);
  /// Shoots photons whose only use is to teach the guides, and drops those that do not pay.
  void trainGuides();
  /// Shoots photons whose hits are only counted until the places that matter have what they require: as many are a
  /// pass's from then on. Those of the maps have other random numbers, so their mean does not depend on it.
  void findEnoughPhotons();
  /// A batch of photons that are in no map; selects their records for the map of their kind.
  void tracePilot(const PhotonSource& source, std::uint32_t first, std::uint32_t count);
  /// As many in batches, with `count` after each; waits for the device.
  void tracePilots(const PhotonSource& source, std::uint32_t photons, const std::function<void()>& count);
  void updateGuides();
  /// Shoots photons whose hits are only counted, so that the first pass reads the caustic map with the right radius.
  void countCausticHits();
  /// Shoots photons whose hits are only counted, for storage by probability.
  void expectDensity();
  [[nodiscard]] StorageRule storageRule(MapKind kind) const;
  /// Null: emission by power.
  [[nodiscard]] EmissionGuide* guideFor(MapKind kind);
  [[nodiscard]] float meanImportance() const;  // pixels/m², if it were the same everywhere
  [[nodiscard]] bool isMapFull() const;
  /// Lowers the required density so that the maps fit in memory; warns.
  void controlHarder();
  void addToDone(int pass);
  void addCounts(PhotonMapStats& stats, const PhotonMapCounts& counts, const char* map);
  [[nodiscard]] EyeMaps eyeMaps() const;
  void addAovs(Image& image, const FilmLayers& layers);
  /// Photons or importons within each pixel, by the name of their layer; 0 without a map.
  [[nodiscard]] std::vector<float> pointLayer(const std::string& name, std::span<const float> aovs) const;

  const RenderJob& job_;
  const Scene& scene_;
  Log& log_;
  RenderStats stats_;
  glm::ivec2 size_;
  FeatureSet features_;
  std::shared_ptr<LoadedDevice> device_;
  DeviceScene deviceScene_;
  PassPlan plan_;
  PassSize now_;  // of the pass at hand
  PassSums done_;
  Parameters parameters_{};
  std::optional<Workspace> work_;
  std::optional<gpu::Recorder> recorder_;
  std::optional<Stage> stage_;
  std::optional<Film> film_;
  SamplePlan samplePlan_{0, 0};
  ImportanceMaps importance_;
  std::optional<PhotonMap> causticMap_, globalMap_;
  std::optional<ExpectedDensity> causticExpected_, globalExpected_;
  std::optional<CellSizes> cellSizes_;
  std::optional<IrradianceMap> irradiance_;  // in place of the global map
  DensityControl control_;
  double surfaceArea_ = 0;  // m²
  std::optional<EmissionGuide> causticGuide_, globalGuide_;
  std::optional<ScatterGuide> scatterGuide_;  // of photons for the global map
  static constexpr int kLearningPasses = 4;
};

}  // namespace importon
