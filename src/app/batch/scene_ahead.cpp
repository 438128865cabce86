#include "app/batch/scene_ahead.h"

#include "app/load_scene.h"
#include "base/clock.h"
#include "render/device_scene/instances.h"

namespace importon {

SceneAhead::SceneAhead(const RenderCommand& command)
    : log_(std::make_unique<Log>(command.verbosity, command.job.scene.filename().string())) {
  log_->hold();
  scene_ = std::async(std::launch::async, [&job = command.job, &log = *log_] {
    const Clock::time_point start = Clock::now();
    PreparedScene prepared{{loadScene(job, log)}, nullptr};
    prepared.loaded.seconds = secondsSince(start);
    prepared.tree = buildTree(prepared.loaded.scene, job);
    prepared.loaded.treeSeconds = secondsSince(start) - prepared.loaded.seconds;
    return prepared;
  });
}

std::shared_ptr<const Bvh> buildTree(const Scene& scene, const RenderJob& job) {
  return std::make_shared<const Bvh>(buildSceneTree(scene, {job.threads, nullptr}));
}

}  // namespace importon
