/// The error of a render against a reference, pass by pass.
#pragma once
#include <string>
#include <vector>

#include "io/image.h"
#include "render/render.h"

namespace importon {

/// What the job's film shows of a reference, which may be of the whole image or of the job's crop. Throws SceneError if
/// it has not the size that the job renders, or with a crop UsageError.
[[nodiscard]] Image ofFilm(Image reference, const std::string& name, const RenderJob& job, const Scene& scene);

class ReferenceErrors {
 public:
  /// Reads the job's reference, if it has one. SceneError if it is unreadable or without colour; of the size: ofFilm.
  ReferenceErrors(const RenderJob& job, const Scene& scene);
  /// Compares the image so far.
  void measure(const RenderProgress& progress);
  /// Adds what was measured; the last pass is the error of the finished `image`, which may have layers.
  void report(ErrorStats& error, const Image& image) const;

 private:
  std::string name_;         // empty: no reference
  Image whole_, reference_;  // with all layers, and in colour alone
  std::vector<ErrorPoint> points_;
};

}  // namespace importon
