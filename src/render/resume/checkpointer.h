/// Checkpoints of a render in progress: when to write them, and going on from one.
#pragma once
#include <chrono>
#include <optional>
#include <utility>

#include "base/log.h"
#include "render/render_job.h"
#include "render/resume/kept.h"

namespace importon {

class Checkpointer {
 public:
  /// Reads the job's checkpoint to resume from, if it names one. `fingerprint`: of the run, whatever decides the bits
  /// of the image but the number of passes. Throws SceneError.
  Checkpointer(const RenderJob& job, std::uint64_t fingerprint, Log& log);
  /// What to go on from, once; none for a fresh start.
  [[nodiscard]] std::optional<Checkpoint> takeStart() { return std::exchange(start_, std::nullopt); }
  /// Writes a checkpoint if the job wants one and the last was a minute ago, or `isEnd`. A failure is a warning:
  /// the image matters more.
  void save(int passes, const std::function<std::vector<CheckpointBlock>()>& state, bool isEnd);
  [[nodiscard]] bool hasFailed() const { return hasFailed_; }

 private:
  const RenderJob& job_;
  std::uint64_t fingerprint_;
  Log& log_;
  std::optional<Checkpoint> start_;
  std::chrono::steady_clock::time_point lastSave_ = std::chrono::steady_clock::now();
  bool hasFailed_ = false;  // the last save
};

}  // namespace importon
