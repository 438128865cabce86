#include "render/plan/camera_matrices.h"

#include <algorithm>
#include <cmath>

#include "render/plan/camera_setup.h"

namespace importon {
namespace {

/// GLM's columns are OpenEXR's rows where vectors stand on the left.
ImageMatrix byRows(const glm::dmat4& matrix) {
  ImageMatrix rows{};
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) rows[static_cast<std::size_t>(4 * i + k)] = static_cast<float>(matrix[i][k]);
  return rows;
}

}  // namespace

CameraMatrices cameraMatrices(const Scene& scene, const RenderJob& job) {
  const Camera& camera = chooseCamera(scene, job);
  const glm::ivec2 size = chooseSize(camera, job);
  const double aspect = static_cast<double>(size.x) / size.y;
  const double halfHeight = camera.isOrthographic ? std::max(camera.ymag, camera.xmag / aspect)  // as setCamera has it
                                                  : std::tan(0.5 * camera.yfov);
  const double halfWidth = halfHeight * aspect;
  glm::dmat4 worldFromView = camera.worldFromCamera;
  worldFromView[2] = -worldFromView[2];  // along the view, which glTF has backwards
  const glm::dmat4 viewFromWorld = glm::inverse(worldFromView);
  // From the middle of the image; what is divided by: the distance along the view, or nothing.
  glm::dmat4 imageFromView(0.0);
  const int one = camera.isOrthographic ? 3 : 2;  // column of what is 1 after the division
  imageFromView[0][0] = 0.5 / halfWidth;
  imageFromView[1][1] = -0.5 / halfHeight;
  imageFromView[one] = glm::dvec4(0.5, 0.5, 0, 1);
  imageFromView[camera.isOrthographic ? 2 : 3][2] = 1;  // the third coordinate means nothing; so there is an inverse
  return {byRows(viewFromWorld), byRows(imageFromView * viewFromWorld)};
}

}  // namespace importon
