#include "render/stop_rule.h"

#include <algorithm>
#include <cmath>

namespace importon {
namespace {

constexpr int kFirstEstimate = 4;   // passes: two in each half
constexpr double kLeastStep = 1.1;  // passes between two estimates, as a factor
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
  if (trend_.error > 0 && error > 0 && passes > trend_.passes) {
    const double slope = std::log(trend_.error / error) / std::log(static_cast<double>(passes) / trend_.passes);
    trend_.slope = std::clamp(slope, kLeastSlope, kMostSlope);
  }
  trend_.error = error;
  trend_.passes = passes;
  estimateSeconds_ = seconds;
}

double StopRule::passesToTarget() const {
  if (trend_.error <= target_) return trend_.passes;
  return trend_.passes * std::pow(trend_.error / target_, 1 / trend_.slope);
}

bool StopRule::wantsEstimate(int passes) const {
  if (target_ < 0 && budget_ < 0) return false;
  if (passes < kFirstEstimate || passes % 2 != 0 || passes <= trend_.passes) return false;
  if (trend_.passes == 0 || passes >= 2 * trend_.passes) return true;
  return target_ >= 0 && passes >= std::max(passesToTarget(), kLeastStep * trend_.passes) - 1;
}

bool StopRule::isDone(int passes, double secondsSinceStart) const {
  if (passes >= maxPasses_) return true;
  if (passes == 0) return false;
  const double finish = estimateSeconds_ + outputSeconds_;
  if (budget_ >= 0 && secondsSinceStart + passSeconds_ + finish > budget_) return true;
  return target_ >= 0 && trend_.passes == passes && trend_.error <= target_;
}

double StopRule::secondsLeft(int passes, double secondsSinceStart) const {
  const double finish = estimateSeconds_ + outputSeconds_;
  double left = passSeconds_ * (maxPasses_ - passes) + finish;
  if (target_ >= 0 && trend_.error >= 0)
    left = std::min(left, passSeconds_ * std::max(passesToTarget() - passes, 0.0) + finish);
  if (budget_ >= 0) left = std::min(left, std::max(budget_ - secondsSinceStart, 0.0));
  return left;
}

}  // namespace importon
