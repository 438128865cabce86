#include "render/plan/camera_setup.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "fmt/format.h"

namespace importon {

const Camera& chooseCamera(const Scene& scene, const RenderJob& job) {
  if (job.camera.empty()) return scene.cameras.front();
  for (const Camera& camera : scene.cameras)
    if (camera.name == job.camera) return camera;
  for (const Camera& camera : scene.cameras)
    if (camera.nodeName == job.camera) return camera;
  std::size_t index = 0;
  const char* end = job.camera.data() + job.camera.size();
  const auto parsed = std::from_chars(job.camera.data(), end, index);
  if (parsed.ec == std::errc() && parsed.ptr == end && index < scene.cameras.size()) return scene.cameras[index];
  std::string names;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    names += (i == 0 ? "" : ", ") + std::to_string(i) + " " + scene.cameras[i].name;
  throw UsageError("no camera '" + job.camera + "'", "--camera", "use one of: " + names);
}

glm::ivec2 chooseSize(const Camera& camera, const RenderJob& job) {
  double aspect = 4.0 / 3.0;
  if (camera.width > 0 && camera.height > 0)
    aspect = static_cast<double>(camera.width) / camera.height;
  else if (camera.isOrthographic)
    aspect = camera.xmag / camera.ymag;
  else if (camera.aspectRatio > 0)
    aspect = camera.aspectRatio;
  const auto rounded = [](double v) { return std::max(1, static_cast<int>(std::lround(v))); };
  if (job.width && job.height) return {*job.width, *job.height};
  if (job.width) return {*job.width, rounded(*job.width / aspect)};
  if (job.height) return {rounded(*job.height * aspect), *job.height};
  if (camera.width > 0 && camera.height > 0) return {camera.width, camera.height};
  return {640, rounded(640 / aspect)};
}

FilmPlace placeFilm(const Camera& camera, const RenderJob& job) {
  const glm::ivec2 whole = chooseSize(camera, job);
  if (!job.crop) return allOf(whole);
  const Crop& crop = *job.crop;
  // Differences, as sums may be too large.
  const bool isWithin = crop.x >= 0 && crop.y >= 0 && crop.width > 0 && crop.height > 0 &&
                        crop.x <= whole.x - crop.width && crop.y <= whole.y - crop.height;
  if (isWithin) return {whole, {crop.x, crop.y}, {crop.width, crop.height}};
  throw UsageError(fmt::format("the crop of {} x {} pixels at {}, {} is not within the image of {} x {}", crop.width,
                               crop.height, crop.x, crop.y, whole.x, whole.y),
                   "--crop", "give X + W and Y + H of at most its width and height");
}

void setCamera(Parameters& p, const Camera& camera, const Scene& scene) {
  const glm::dmat3 axes(camera.worldFromCamera);
  const glm::dvec3 origin = glm::dvec3(camera.worldFromCamera[3]) - scene.worldFromRender;
  const double aspect = static_cast<double>(p.imageSize.x) / static_cast<double>(p.imageSize.y);
  double halfHeight = std::tan(0.5 * camera.yfov), halfWidth = halfHeight * aspect;
  if (camera.isOrthographic) {
    // The image shows at least what the camera spans: one side fits, the other follows the image's shape.
    halfHeight = std::max(camera.ymag, camera.xmag / aspect);
    halfWidth = halfHeight * aspect;
  }
  p.cameraIsOrthographic = camera.isOrthographic ? 1 : 0;
  p.cameraOrigin = vec3(origin);
  p.cameraForward = vec3(-axes[2]);
  p.cameraRight = vec3(axes[0] * halfWidth);
  p.cameraUp = vec3(axes[1] * halfHeight);
}

}  // namespace importon
