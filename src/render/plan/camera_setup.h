/// The camera and the image size of a job.
#pragma once
#include "render/render_job.h"
#include "scene/scene.h"
#include "shared/render_data.h"

namespace importon {

/// The camera that the job names. Throws UsageError if there is none of that name or index.
[[nodiscard]] const Camera& chooseCamera(const Scene& scene, const RenderJob& job);

/// Pixels of the whole image: the job's, else the camera's extras, else 640 wide at the camera's aspect ratio.
[[nodiscard]] glm::ivec2 chooseSize(const Camera& camera, const RenderJob& job);

/// What is rendered of the image: `size` pixels from `corner` on, of `whole` ones.
struct FilmPlace {
  glm::ivec2 whole{1}, corner{0}, size{1};
};

[[nodiscard]] inline FilmPlace allOf(glm::ivec2 whole) { return {whole, glm::ivec2(0), whole}; }

/// The job's crop, else all of the image. Throws UsageError if the crop is not within the image.
[[nodiscard]] FilmPlace placeFilm(const Camera& camera, const RenderJob& job);

/// A thin lens in the camera's place. Without a radius the camera is a pinhole.
struct Lens {
  double radius = 0;         // m
  double focusDistance = 1;  // m, along the view

  [[nodiscard]] bool isPinhole() const { return radius == 0; }
};

/// The job's lens, else the camera's own; of what one of them leaves open the other one decides. Throws UsageError
/// where the job asks for what no lens is: for an orthographic camera, or in focus nearer than the focal length.
[[nodiscard]] Lens chooseLens(const Camera& camera, const RenderJob& job);

/// Enters the camera into the parameters; imageSize must stand there.
void setCamera(Parameters& parameters, const Camera& camera, const Lens& lens, const Scene& scene);

}  // namespace importon
