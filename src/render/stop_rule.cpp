#include "render/stop_rule.h"

#include <algorithm>
#include <cmath>

namespace importon {
namespace {

constexpr int kFirstEstimate = 4;        // passes: two in each half
constexpr double kEstimateShare = 0.05;  // of the time at most goes into estimates that the target does not need
constexpr double kLeastSlope = 0.2, kMostSlope = 0.5;

}  // namespace

StopRule::StopRule(const RenderJob& job, int maxPasses, double finishSeconds)
    : maxPasses_(maxPasses), budget_(job.seconds.value_or(-1)), outputSeconds_(finishSeconds) {
  if (job.error) target_ = *job.error;
  else if (!job.passes && !job.seconds) target_ = kDefaultError;
}

void StopRule::passTook(double seconds) {
  passSeconds_ = std::max(seconds, lastPassSeconds_);
  lastPassSeconds_ = seconds;
}

void StopRule::errorIs(int passes, double error, double seconds) {
  if (error_ > 0 && error > 0 && passes > errorPasses_) {
    const double slope = std::log(error_ / error) / std::log(static_cast<double>(passes) / errorPasses_);
    slope_ = std::clamp(slope, kLeastSlope, kMostSlope);
  }
  error_ = error;
  errorPasses_ = passes;
  estimateSeconds_ = seconds;
}

double StopRule::passesToTarget() const {
  if (error_ <= target_) return errorPasses_;
  return errorPasses_ * std::pow(error_ / target_, 1 / slope_);
}

bool StopRule::wantsEstimate(int passes, double secondsSinceStart) const {
  if (passes < kFirstEstimate || passes % 2 != 0 || passes <= errorPasses_) return false;
  if (errorPasses_ == 0) return target_ >= 0 || budget_ >= 0;
  const bool isDue = passes >= 2 * errorPasses_ || (target_ >= 0 && passes + 1 >= passesToTarget());
  const bool isCheap = estimateSeconds_ <= kEstimateShare * secondsSinceStart;
  // Near the target an estimate that comes too late costs two passes.
  const bool isNear = target_ >= 0 && passes + 1 >= passesToTarget() && estimateSeconds_ < 2 * passSeconds_;
  return isDue && (isCheap || isNear || passes >= 2 * errorPasses_);
}

bool StopRule::isDone(int passes, double secondsSinceStart) const {
  if (passes >= maxPasses_) return true;
  if (passes == 0) return false;
  const double finish = estimateSeconds_ + outputSeconds_;
  if (budget_ >= 0 && secondsSinceStart + passSeconds_ + finish > budget_) return true;
  return target_ >= 0 && errorPasses_ == passes && error_ <= target_;
}

double StopRule::secondsLeft(int passes, double secondsSinceStart) const {
  const double finish = estimateSeconds_ + outputSeconds_;
  double left = passSeconds_ * (maxPasses_ - passes) + finish;
  if (target_ >= 0 && error_ >= 0) left = std::min(left, passSeconds_ * std::max(passesToTarget() - passes, 0.0) + finish);
  if (budget_ >= 0) left = std::min(left, std::max(budget_ - secondsSinceStart, 0.0));
  return left;
}

}  // namespace importon
