#include "app/batch/sequence_camera.h"

#include "app/load_scene.h"
#include "render/plan/camera_setup.h"
#include "scene/framing.h"
#include "scene/turntable.h"

namespace importon {

void SequenceCamera::place(const RenderJob& job, Scene& scene) {
  if (!job.frame || (scene.hasCameraInFile && !job.turntable)) return;
  if (!fixed_ && (!job.frames || job.at == 0)) fixed_ = fixedBy(job, scene);
  if (!fixed_) {
    RenderJob first = job;
    first.at = 0;
    Log silent(Log::Verbosity::quiet);
    silent.hold();  // the frames tell of what is wrong
    fixed_ = fixedBy(first, loadScene(first, silent));
  }
  const Camera& own = chooseCamera(scene, job);
  Camera camera = fixed_->camera.value_or(own);
  if (job.turntable)
    camera =
        turnedAround(camera, fixed_->centre, static_cast<double>(*job.frame) / static_cast<double>(*job.turntable));
  scene.cameras[static_cast<std::size_t>(&own - scene.cameras.data())] = camera;
}

SequenceCamera::Fixed SequenceCamera::fixedBy(const RenderJob& job, const Scene& first) {
  const Camera& camera = chooseCamera(first, job);
  Fixed fixed{{}, turntableCentre(first, camera)};
  if (!first.hasCameraInFile) fixed.camera = job.turntable ? roundFramingCamera(first, camera.aspectRatio) : camera;
  return fixed;
}

}  // namespace importon
