/// The camera of a sequence.
#pragma once
#include <optional>

#include "base/log.h"
#include "render/render_job.h"
#include "scene/scene.h"

namespace importon {

/// Frames of a scene without a camera are seen from one place, and a turntable goes around one axis, however the scene
/// moves: those of its pose at 0 s.
class SequenceCamera {
 public:
  /// Puts the camera of the job's frame into the scene, whose cameras are as the file has them. May load the scene in
  /// another pose. Throws SceneError and UsageError. Of a job that is no frame: does nothing.
  void place(const RenderJob& job, Scene& scene);

 private:
  struct Fixed {
    std::optional<Camera> camera;  // none: the file's
    glm::dvec3 centre{0.0};        // of the turntable
  };
  [[nodiscard]] static Fixed fixedBy(const RenderJob& job, const Scene& first);

  std::optional<Fixed> fixed_;
};

}  // namespace importon
