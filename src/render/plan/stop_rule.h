/// When a render has done enough: passes, time, or estimated error.
#pragma once
#include "render/plan/pass_plan.h"

namespace importon {

/// The error at which a job that sets no limit of its own stops.
inline constexpr double kDefaultError = 0.05;

/// What is known of the error of a render in progress.
struct ErrorTrend {
  double error = -1;   // the last estimate; negative: none
  int passes = 0;      // at which it was found
  double slope = 0.4;  // s, if the error of n passes goes as n^-s; from the last two estimates, within [0.2, 0.5]
};

/// Told what passes and estimates take and bring; says when to estimate the error, when to stop, and how long it
/// will be. All seconds are wall clock. Without a time budget nothing that is decided depends on time.
class StopRule {
 public:
  /// `finishSeconds`: a first guess of what resolving and writing the image takes; estimates correct it.
  StopRule(const RenderJob& job, int maxPasses, double finishSeconds);

  /// Of the passes in all; the devices of a render may share them out anew.
  void setMaxPasses(int maxPasses) { maxPasses_ = maxPasses; }
  /// A pass of so many of kPartsOfPass parts was made.
  void passTook(double seconds, int parts = kPartsOfPass);
  /// `seconds` is what finding it took: about as much as resolving the image at the end will.
  void errorIs(int passes, double error, double seconds);

  /// True if the error should be estimated now: where the target may have been reached, at the latest when the
  /// passes have doubled, and not before a tenth more are done, since an estimate takes time.
  [[nodiscard]] bool wantsEstimate(int passes) const;
  /// How many of kPartsOfPass parts the next pass is to have: few at first, so that an image is there soon and a high
  /// error is not undercut by far, and no more than there is time for beside writing the image. 0: no further pass,
  /// since there were enough, the error is reached, or no time is left. One pass is always made. With a checkpoint
  /// sizes do not depend on time, so that the run is the same wherever it stops.
  [[nodiscard]] int partsOfNext(int passes, double secondsSinceStart) const;

  /// Until the last pass, as far as is known; negative: not known.
  [[nodiscard]] double secondsLeft(int passes, double secondsSinceStart) const;
  /// That a whole pass takes; 0: none was made yet.
  [[nodiscard]] double passSeconds() const { return passSeconds_; }
  /// For a run that goes on from where another one stopped.
  [[nodiscard]] const ErrorTrend& trend() const { return trend_; }
  [[nodiscard]] ErrorTrend& trend() { return trend_; }
  /// The error that the render is to reach; negative: none.
  [[nodiscard]] double target() const { return target_; }

 private:
  /// Passes after which the error is expected to be at its target, from the last estimate.
  [[nodiscard]] double passesToTarget() const;

  int maxPasses_;
  double budget_ = -1;        // s since the process started, negative: none
  double target_ = -1;        // error, negative: none
  bool beginsSmall_ = false;  // the first passes are smaller than whole ones
  bool endsSmall_ = false;    // so are the last ones of a time budget
  double passSeconds_ = 0;    // of a whole pass, from the slower of the last two
  double lastPassSeconds_ = 0;
  double estimateSeconds_ = 0, outputSeconds_ = 0;
  ErrorTrend trend_;
};

}  // namespace importon
