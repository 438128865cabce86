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

Lens chooseLens(const Camera& camera, const RenderJob& job) {
  const bool isAskedFor = job.fStop || job.focus;
  const double fStop = job.fStop.value_or(camera.fStop), focus = job.focus.value_or(camera.focusDistance);
  const auto refuse = [&](const std::string& what, const char* where, const char* advice) {
    if (isAskedFor) throw UsageError(what, where, advice);
    return Lens();  // the reader of the file has warned
  };
  if (fStop == 0 && focus == 0) return {};
  if (camera.isOrthographic)
    return refuse("an orthographic camera has no lens", job.fStop ? "--f-stop" : "--focus",
                  "leave it out, or choose a perspective camera by --camera");
  if (focus == 0)
    return refuse("--f-stop needs a distance in focus, --focus", "--f-stop", "give both, or leave it out");
  if (fStop == 0) return refuse("--focus needs a lens, --f-stop", "--focus", "give both, or leave it out");
  const double focalLength = camera.focalLength();
  if (focus <= focalLength)
    return refuse(fmt::format("nothing at {:.6g} m can be in focus of a focal length of {:.6g} m", focus, focalLength),
                  "--focus", "give a greater distance");
  return {0.5 * focalLength / fStop, focus};
}

void setCamera(Parameters& p, const Camera& camera, const Lens& lens, const Scene& scene) {
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
  p.lensRight = vec3(axes[0] * lens.radius);
  p.lensUp = vec3(axes[1] * lens.radius);
  p.inverseFocus = static_cast<float>(1 / lens.focusDistance);
}

}  // namespace importon
