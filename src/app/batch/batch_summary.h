/// What became of the jobs of a batch.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "base/error.h"
#include "render/render_stats.h"

namespace importon {

/// A picture that was made or not. Of a job that makes one for each camera and failed before: the job.
struct BatchResult {
  RenderJob job;
  std::string camera;  // its name or index; empty: not known, as the scene was not loaded
  ExitStatus status = ExitStatus::ok;
  std::string error;  // what it failed of
  double seconds = 0;
  std::optional<RenderStats> stats = std::nullopt;  // none: no picture
  std::vector<Warning> warnings = {};
};

/// Interrupted if any is, else the numerically highest.
[[nodiscard]] ExitStatus worstStatus(const std::vector<BatchResult>& results);

/// The file that --stats names in a batch, as JSON text: docs/batches.md.
[[nodiscard]] std::string summaryJson(const BatchCommand& command, const std::vector<BatchResult>& results,
                                      double seconds);

}  // namespace importon
