/// A render of a scene that is there, up to its files.
#pragma once
#include <atomic>
#include <chrono>
#include <optional>
#include <string>

#include "app/command_line.h"
#include "base/error.h"
#include "render/render.h"

namespace importon {

/// A scene, and what it took to load it and, ahead of the render, to build its tree.
struct LoadedScene {
  Scene scene;
  double seconds = 0, treeSeconds = 0;
};

/// What became of a render. `stats`: none if no image was written.
struct RenderOutcome {
  ExitStatus status = ExitStatus::ok;
  std::optional<RenderStats> stats = std::nullopt;
};

/// Sees that all files of the job can be written. Throws OutputError.
void checkOutputs(const RenderJob& job);

/// Says what of the command changes nothing, and what gather rays read.
void tellOfOptions(const RenderCommand& command, Log& log);

/// Renders and writes; `start` is when the job began. `progress` stands before the progress line. Throws SceneError,
/// DeviceError and OutputError.
[[nodiscard]] RenderOutcome renderLoaded(const RenderJob& job, const LoadedScene& loaded, Log& log,
                                         const std::atomic<bool>& isInterrupted,
                                         std::chrono::steady_clock::time_point start, const RenderSources& sources = {},
                                         const std::string& progress = "");

}  // namespace importon
