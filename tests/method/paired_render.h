/// Renders of the same photons by other rules than the classical map, and what they are judged against: what holds
/// claims about density control.
#pragma once
#include "method/render_scene.h"
#include "render/importance/importance.h"
#include "support/statistics.h"

namespace importon::test {

/// A reference in two halves of different random numbers.
struct ReferenceHalves {
  RenderResult a, b;

  /// Relative mean square error of the mean of both, by what they differ.
  [[nodiscard]] double ownError() const;
  /// That of an image, without what the reference's own noise adds: mean over pixels and channels of
  /// (I-A)(I-B) / (T² + 0.01 mean(T)²), T the mean of both halves.
  [[nodiscard]] double errorOf(const RenderResult& image) const;
};

/// Renders the job with its seed and the next one.
[[nodiscard]] ReferenceHalves renderHalves(const Scene& scene, RenderJob job);

/// What a rule changes, over several seeds.
struct PairedFigures {
  Moments meanRatio;     // of the image to that of the classical map
  Moments errorRatio;    // the same of the errors, logarithms
  Moments stored, hits;  // photons in the map of the rule, and in the classical one
  Moments timesFewer;    // the latter over the former
  Moments error;         // of the classical map's image
  Moments bytesRatio;    // of what all maps take
};

/// All of them, as docs/talk.md has them.
[[nodiscard]] std::string describe(const PairedFigures& figures);

/// Renders each of the jobs, and the same photons with the classical map: no control, gathers that read photons. The
/// first job says how, and the first of the seeds. Fails the test where two images are the same, since then nothing is
/// judged, and where the reference's own error is more than a tenth of the error that it judges.
[[nodiscard]] std::vector<PairedFigures> judgeAgainstClassicalMap(const Scene& scene, std::vector<RenderJob> jobs,
                                                                  int seeds, MapKind kind,
                                                                  const ReferenceHalves* reference = nullptr);

}  // namespace importon::test
