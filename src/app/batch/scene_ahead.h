/// The scene of the next job, loaded while the present one is rendered.
#pragma once
#include <future>
#include <memory>

#include "accel/bvh.h"
#include "app/command_line.h"
#include "app/render_loaded.h"

namespace importon {

/// A scene with the tree over it.
struct PreparedScene {
  LoadedScene loaded;
  std::shared_ptr<const Bvh> tree;
};

/// Loads on a thread of its own from the constructor on. The destructor waits for it. The job must last.
class SceneAhead {
 public:
  explicit SceneAhead(const RenderCommand& command);

  /// The messages of the job, held back until release().
  [[nodiscard]] Log& log() { return *log_; }
  /// Waits. Throws SceneError, UsageError. Once.
  [[nodiscard]] PreparedScene take() { return scene_.get(); }

 private:
  std::unique_ptr<Log> log_;
  std::future<PreparedScene> scene_;  // before the log is gone, the thread has ended
};

/// Builds the tree over a scene. Throws SceneError.
[[nodiscard]] std::shared_ptr<const Bvh> buildTree(const Scene& scene, const RenderJob& job);

}  // namespace importon
