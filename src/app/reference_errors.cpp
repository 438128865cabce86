#include "app/reference_errors.h"

#include "base/error.h"
#include "fmt/format.h"
#include "io/layers.h"
#include "render/plan/camera_setup.h"
#include "report/compare.h"
#include "report/plain_surfaces.h"

namespace importon {

ReferenceErrors::ReferenceErrors(const RenderJob& job, const Scene& scene) : name_(job.reference.string()) {
  if (name_.empty()) return;
  whole_ = readExr(job.reference);
  reference_ = takeColor(whole_, "", name_);
  const glm::ivec2 size = chooseSize(chooseCamera(scene, job), job);
  if (reference_.width == size.x && reference_.height == size.y) return;
  throw SceneError(fmt::format("the reference has {} x {} pixels, the image {} x {}", reference_.width,
                               reference_.height, size.x, size.y),
                   name_, "render both at the same size");
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
