#include "app/reference_errors.h"

#include "base/error.h"
#include "fmt/format.h"
#include "io/image_part.h"
#include "io/layers.h"
#include "render/plan/camera_setup.h"
#include "report/compare.h"
#include "report/plain_surfaces.h"

namespace importon {

Image ofFilm(Image reference, const std::string& name, const RenderJob& job, const Scene& scene) {
  const FilmPlace film = placeFilm(chooseCamera(scene, job), job);
  const bool isPart = reference.whole.width > 0;
  if (reference.width == film.size.x && reference.height == film.size.y && (!isPart || !job.crop)) return reference;
  const std::string sizes = fmt::format("the reference has {} x {} pixels, the image {} x {}", reference.width,
                                        reference.height, film.size.x, film.size.y);
  if (!job.crop) throw SceneError(sizes, name, "render both at the same size");
  const glm::ivec2 whole = isPart ? glm::ivec2(reference.whole.width, reference.whole.height)
                                  : glm::ivec2(reference.width, reference.height);
  if (whole == film.whole)
    if (auto part = cutOut(reference, film.corner.x, film.corner.y, film.size.x, film.size.y)) return *std::move(part);
  throw UsageError(fmt::format("{} of {} x {}", sizes, film.whole.x, film.whole.y), name,
                   "give a reference of the whole image, or of the crop");
}

ReferenceErrors::ReferenceErrors(const RenderJob& job, const Scene& scene) : name_(job.reference.string()) {
  if (name_.empty()) return;
  whole_ = ofFilm(readExr(job.reference), name_, job, scene);
  reference_ = takeColor(whole_, "", name_);
}

void ReferenceErrors::measure(const RenderProgress& progress) {
  if (name_.empty()) return;
  const ValueErrors errors = compareValues(progress.image(), "the image", reference_, name_);
  points_.push_back({progress.pass, progress.seconds, errors.relmse, errors.relmseTrimmed, errors.smape});
}

void ReferenceErrors::report(ErrorStats& error, const Image& image) const {
  if (points_.empty()) return;
  error.relmse = points_.back().relmse;
  error.relmseTrimmed = points_.back().relmseTrimmed;
  error.smape = points_.back().smape;
  error.passes = points_;
  constexpr double kPercent = 100;
  const Image color = takeColor(image, "", "the image");
  error.band = kPercent * bandError(color, reference_, findPlainSurfaces(whole_, reference_, image, color)).rms;
}

}  // namespace importon
