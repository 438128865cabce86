/// The camera and the image size of a job.
#pragma once
#include "render/render_job.h"
#include "scene/scene.h"
#include "shared/render_data.h"

namespace importon {

/// The camera that the job names. Throws UsageError if there is none of that name or index.
[[nodiscard]] const Camera& chooseCamera(const Scene& scene, const RenderJob& job);

/// Pixels: the job's, else the camera's extras, else 640 wide at the camera's aspect ratio.
[[nodiscard]] glm::ivec2 chooseSize(const Camera& camera, const RenderJob& job);

/// Enters the camera into the parameters; width and height must stand there.
void setCamera(Parameters& parameters, const Camera& camera, const Scene& scene);

}  // namespace importon
