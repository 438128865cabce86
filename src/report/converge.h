/// Error against time: several configurations, several seeds, a list of time budgets.
#pragma once
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "base/log.h"
#include "render/render_job.h"
#include "report/compare.h"
#include "report/error_statistics.h"
#include "report/plain_surfaces.h"
#include "scene/scene.h"

namespace importon {

/// A way to render, with a name. The seed and the limits of the job are set for each run.
struct ConvergeConfig {
  std::string name;
  std::string options;  // as given on the command line
  RenderJob job;
};

struct ConvergePlan {
  std::vector<ConvergeConfig> configs;  // the first one sets the levels of equal error
  std::vector<double> budgets;          // s of wall clock, rising; start-up counts, measuring doesn't
  int seeds = 4;                        // 1, 2, ...
  double loadSeconds = 0;               // that loading the scene took: part of every run's time
};

/// A run when a budget was nearly used up: after the last pass that fitted.
struct ConvergePoint {
  double budget = 0, seconds = 0;  // allowed; used, resolving the image counted
  int passes = 0;
  std::uint64_t photonsEmitted = 0, photonsStored = 0;  // sums over passes
  ValueErrors errors;
  BandError band = {};
};

struct ConvergeRun {
  std::uint32_t seed = 0;
  std::vector<ConvergePoint> points;  // budgets within which no pass fitted are left out
  std::uint64_t devicePeakBytes = 0, photonMapBytes = 0;
};

/// What the seeds tell of one budget.
struct ConvergeSummary {
  double budget = 0;
  Interval seconds, error;  // trimmed relMSE
  std::optional<ErrorParts> parts;
};

struct ConvergeResult {
  ConvergeConfig config;
  std::vector<ConvergeRun> runs;
  std::vector<ConvergeSummary> summaries;            // budgets that some run has a point for
  std::vector<std::optional<Interval>> timeToError;  // s for each level; empty: not reached by every seed
  Image image;                                       // of the first seed at its last point
};

struct ConvergeReport {
  std::string deviceName, deviceDriver;
  std::vector<double> levels;  // trimmed relMSE, falling: of the first configuration's curve
  std::vector<ConvergeResult> results;
};

/// Renders all seeds of all configurations, one run each to the last budget. `tell` is called before each run.
/// Stops between runs when `isInterrupted`, with what there is. Throws DeviceError, and SceneError where the
/// reference has another size.
[[nodiscard]] ConvergeReport converge(const ConvergePlan& plan, const Scene& scene, const Image& reference,
                                      const std::string& referenceName, Log& log,
                                      const std::atomic<bool>& isInterrupted,
                                      const std::function<void(const std::string&)>& tell);

/// Fills in summaries' intervals, levels and times to equal error from the runs.
void summarize(ConvergeReport& report);

}  // namespace importon
