/// The error of a render against a reference, pass by pass.
#pragma once
#include <string>
#include <vector>

#include "io/image.h"
#include "render/render.h"

namespace importon {

class ReferenceErrors {
 public:
  /// Reads the job's reference, if it has one. SceneError if it is unreadable, without colour, or not of the size
  /// that the job renders.
  ReferenceErrors(const RenderJob& job, const Scene& scene);
  /// Compares the image so far.
  void measure(const RenderProgress& progress);
  /// Adds what was measured; the last pass is the image's error.
  void report(ErrorStats& error) const;

 private:
  std::string name_;  // empty: no reference
  Image reference_;
  std::vector<ErrorPoint> points_;
};

}  // namespace importon
