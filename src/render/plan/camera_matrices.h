/// Where the camera of an image stood, as OpenEXR's standard attributes tell it.
#pragma once
#include "io/image.h"
#include "render/render_job.h"
#include "scene/scene.h"

namespace importon {

/// worldToCamera: metres from the camera to the right, up and along its view. worldToNDC: after division by the fourth
/// coordinate, shares of the image's width and height from its upper left corner. Row vectors are multiplied by them
/// from the left. [OpenEXR, "Standard Attributes"]
struct CameraMatrices {
  ImageMatrix worldToCamera, worldToNdc;
};

/// Of the camera and the whole image of the job.
[[nodiscard]] CameraMatrices cameraMatrices(const Scene& scene, const RenderJob& job);

}  // namespace importon
