/// Camera paths of the passes, and the film that they add to.
#pragma once
#include "render/camera/eye_pass.h"
#include "render/device/pass_context.h"
#include "render/film/film.h"
#include "render/film/film_sums.h"

namespace importon {

class CameraPass {
 public:
  explicit CameraPass(PassContext& context);

  /// Traces the paths of pass `pass`, which follows those of `before`.
  void gather(int pass, const PassSums& before, const EyeMaps& maps);
  /// The film of the passes that are done, whose number and seeds are left open.
  [[nodiscard]] FilmSums read(const PassSums& done) const;
  /// The AOV buffer of the whole image, kAovFloats per pixel, of the maps that there are.
  [[nodiscard]] std::vector<float> traceAovs(const EyeMaps& maps) const;
  void addKept(std::vector<Kept>& state);

 private:
  PassContext& context_;
  Film film_;
  AdaptiveSampler sampler_;
};

}  // namespace importon
