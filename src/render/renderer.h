/// The method, phase by phase.
#pragma once
#include "io/image.h"
#include "render/camera/camera_pass.h"
#include "render/run_totals.h"

namespace importon {

/// The method: importance and required density for each map, guides, passes, image. Job, scene and log must last.
class Renderer {
 public:
  Renderer(const RenderJob& job, const Scene& scene, Log& log, const RenderSources& sources = {});

  /// Importance, required density and guides, before the first pass.
  void prepare();
  /// Pass `pass`, of `parts` of kPartsOfPass parts: photons into the maps, camera paths into the film.
  void renderPass(int pass, int parts);

  /// All that lasts from pass to pass.
  [[nodiscard]] std::vector<Kept> state();
  /// Has ready what state() is to be taken up into, after `passes` passes; and what follows from it.
  void prepareState(int passes);
  void stateRestored(int passes);
  /// Of the run: all that decides the bits of the image but the number of passes.
  [[nodiscard]] std::uint64_t fingerprint() const;

  /// The film so far; those of several renderers of one image may be added up. Passes and seeds are left open.
  [[nodiscard]] FilmSums film() const { return camera_.read(totals_.done()); }
  /// What a film shows, its own or one of several.
  [[nodiscard]] FilmLayers resolve(const FilmSums& film) const;
  /// The image of a film, and with the layers that the job asks for; those of maps are of this renderer's.
  [[nodiscard]] Image image(const FilmLayers& layers) const;
  [[nodiscard]] Image imageWithLayers(const FilmLayers& layers);
  /// Statistics so far, and at the end.
  [[nodiscard]] const RenderStats& stats() const { return stats_; }
  [[nodiscard]] RenderStats finish(int passes);
  [[nodiscard]] PassContext& context() { return context_; }
  [[nodiscard]] PassSums& done() { return totals_.done(); }

 private:
  void findImportance();
  void cutCells(int pass);
  void shootPhotons(int pass);
  void gatherImage(int pass);
  [[nodiscard]] EyeMaps eyeMaps() const;

  RenderStats stats_;
  PassContext context_;
  PhotonSystem caustic_, global_;
  SurfaceCache cache_;  // in place of the global map
  CameraPass camera_;
  RunTotals totals_;
};

}  // namespace importon
