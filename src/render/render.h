/// Renders a scene until the job has what it asks for.
#pragma once
#include <atomic>
#include <chrono>
#include <functional>

#include "base/log.h"
#include "io/image.h"
#include "render/device/pass_context.h"
#include "render/render_stats.h"

namespace importon {

/// Told after every pass. Negative: not known.
struct RenderProgress {
  int pass = 0, passes = 0;
  double seconds = 0, photonsPerSecond = 0, raysPerSecond = 0, secondsLeft = -1;
  double error = -1, target = -1;      // estimated relative error of the image; the one at which to stop
  const RenderStats* stats = nullptr;  // so far
  std::function<Image()> image = {};   // the image so far, resolved anew at each call: without AOVs
};

struct RenderResult {
  Image image;
  RenderStats stats;
  std::vector<std::uint32_t> seeds;  // of the passes in the image
  bool wasInterrupted = false;
  bool lacksCheckpoint = false;  // the last one could not be written
};

/// Renders on the job's devices until the job's limits are reached or `isInterrupted` turns true (asked between
/// passes); then returns the image so far. `start` is when the process started: the job's seconds count from there,
/// without those spent in `progress`. `sources` give it a device with kernels, and a tree. Throws DeviceError.
[[nodiscard]] RenderResult render(const RenderJob& job, const Scene& scene, Log& log,
                                  const std::atomic<bool>& isInterrupted,
                                  const std::function<void(const RenderProgress&)>& progress,
                                  std::chrono::steady_clock::time_point start, const RenderSources& sources = {});

}  // namespace importon
