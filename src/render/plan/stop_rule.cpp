#include "render/plan/stop_rule.h"

#include <algorithm>
#include <cmath>

namespace importon {
namespace {

constexpr int kFirstEstimate = 4;    // passes: two in each half
constexpr double kLeastStep = 1.1;   // passes between two estimates, as a factor
constexpr double kFixedShare = 0.1;  // of a whole pass's time, that smaller ones take too
constexpr double kStartSeconds = 1;
constexpr double kLeastSlope = 0.2, kMostSlope = 0.5;

/// Of the time of a whole pass.
double shareOfTime(int parts) { return kFixedShare + (1 - kFixedShare) * parts / kPartsOfPass; }

}  // namespace

StopRule::StopRule(const RenderJob& job, int maxPasses, double finishSeconds)
    : maxPasses_(maxPasses), budget_(job.seconds.value_or(-1)), outputSeconds_(finishSeconds) {
  if (job.error)
    target_ = *job.error;
  else if (!job.passes && !job.seconds)
    target_ = kDefaultError;
  // Passes are alike where their number alone or what they do is given, and where an expected density rests on that.
  beginsSmall_ = job.integrator == Integrator::photon && (job.seconds || target_ >= 0) && !job.gather &&
                 job.control != DensityControl::probability;
  endsSmall_ = beginsSmall_ && job.checkpoint.empty();
}

void StopRule::passTook(double seconds, int parts) {
  // The first pass starts kernels, which takes the others no time.
  if (lastPassSeconds_ <= 0) seconds -= std::min(kStartSeconds, seconds / 2);
  const double whole = seconds / shareOfTime(parts);
  passSeconds_ = std::max(whole, lastPassSeconds_);
  lastPassSeconds_ = whole;
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

int StopRule::partsOfNext(int passes, double secondsSinceStart) const {
  if (passes >= maxPasses_) return 0;
  if (target_ >= 0 && trend_.passes == passes && passes > 0 && trend_.error <= target_) return 0;
  int parts = kPartsOfPass;
  if (beginsSmall_)
    parts = std::min(1 << std::min(passes / 2, 10), kPartsOfPass);  // passes come in pairs: one for each half
  if (budget_ < 0 || passes == 0) return parts;
  const double left = budget_ - secondsSinceStart - estimateSeconds_ - outputSeconds_;
  while (passSeconds_ * shareOfTime(parts) > left) {
    if (!endsSmall_ || parts == 1) return 0;
    parts /= 2;
  }
  return parts;
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
