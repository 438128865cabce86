/// Checkpoints of a render in progress: when to write them, and going on from one.
#pragma once
#include <chrono>
#include <optional>

#include "render/render_session.h"
#include "render/stop_rule.h"

namespace importon {

class Pause {
 public:
  /// Reads the job's checkpoint to resume from, if it names one. Throws SceneError.
  Pause(const RenderJob& job, RenderSession& session, Log& log);
  /// Takes up the state; returns the passes that are done already, 0 for a fresh start.
  [[nodiscard]] int resume(StopRule& rule);
  /// Writes a checkpoint if the job wants one and the last was a minute ago, or `isEnd`. A failure is a warning:
  /// the image matters more.
  void save(const StopRule& rule, int passes, bool isEnd);
  [[nodiscard]] bool hasFailed() const { return hasFailed_; }

 private:
  const RenderJob& job_;
  RenderSession& session_;
  Log& log_;
  std::optional<Checkpoint> start_;
  std::chrono::steady_clock::time_point lastSave_ = std::chrono::steady_clock::now();
  bool hasFailed_ = false;  // the last save
};

}  // namespace importon
