/// The talk's figures for any scene: importons, importance, required density, photon hits, photon density, the maps
/// seen directly and the image, for several ways to store photons.
#pragma once
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "base/log.h"
#include "render/render_job.h"
#include "render/render_stats.h"
#include "report/compare.h"
#include "scene/scene.h"

namespace importon {

/// A way to render, with a name.
struct StudyConfig {
  std::string name;
  std::string options;  // as on the command line
  RenderJob job;
};

/// What it gave.
struct StudyResult {
  StudyConfig config;
  Image image;  // with the layers of studyLayers
  RenderStats stats;
  Comparison againstFirst;  // the image against that of the first configuration
};

struct StudyReport {
  std::vector<StudyResult> results;
};

/// The layers that the figures are made from.
[[nodiscard]] std::vector<std::string> studyLayers();

/// Renders every configuration with all layers. `tell` hears which one is at work. An interrupt ends the study after
/// the pass at work, without the configurations that are left. Throws what render() throws.
[[nodiscard]] StudyReport study(const std::vector<StudyConfig>& configs, const Scene& scene, Log& log,
                                const std::atomic<bool>& isInterrupted,
                                const std::function<void(const std::string&)>& tell);

}  // namespace importon
