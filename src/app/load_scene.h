/// The scene of a job.
#pragma once
#include "base/log.h"
#include "render/render_job.h"
#include "scene/load_options.h"

namespace importon {

/// How the job's scene is loaded; reads the file of --environment. Throws SceneError.
[[nodiscard]] LoadOptions loadOptions(const RenderJob& job);

/// Loads the job's scene, and notes what it gets that the file lacks: light, a camera. Throws SceneError.
[[nodiscard]] Scene loadScene(const RenderJob& job, Log& log);

}  // namespace importon
