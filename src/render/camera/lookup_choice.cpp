#include "render/camera/lookup_choice.h"

#include <algorithm>
#include <limits>

namespace importon {
namespace {

/// Mean of (a-b)² over what is seen there by the lookup with most photons, squared, with a hundredth of the mean
/// square.
double relativeSquare(std::span<const float> a, std::span<const float> b, const LookupTrial& smooth) {
  double square = 0, mean = 0;
  const auto seen = [&](std::size_t i) {
    return 0.5 * (static_cast<double>(smooth.a[i]) + static_cast<double>(smooth.b[i]));
  };
  for (std::size_t i = 0; i < a.size(); ++i) mean += seen(i);
  mean /= static_cast<double>(std::max<std::size_t>(a.size(), 1));
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
    const double scale = seen(i) * seen(i) + 0.01 * mean * mean;
    if (scale > 0) square += difference * difference / scale;
  }
  return square / static_cast<double>(std::max<std::size_t>(a.size(), 1));
}

}  // namespace

std::vector<LookupError> lookupErrors(std::span<const LookupTrial> trials) {
  std::vector<LookupError> errors;
  const LookupTrial &first = trials.front(), &last = trials.back();
  for (const LookupTrial& trial : trials) {
    LookupError error;
    error.variance = 0.5 * relativeSquare(trial.a, trial.b, last);
    const double firstVariance = errors.empty() ? error.variance : errors.front().variance;
    const double crossed = 0.5 * (relativeSquare(trial.a, first.b, last) + relativeSquare(trial.b, first.a, last));
    error.bias = std::max(crossed - error.variance - firstVariance, 0.0);
    errors.push_back(error);
  }
  return errors;
}

int chooseLookupPhotons(std::span<const LookupTrial> trials, int passes) {
  int chosen = trials.front().photons;
  double least = std::numeric_limits<double>::max();
  const std::vector<LookupError> errors = lookupErrors(trials);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const double error = errors[i].variance / passes + errors[i].bias;
    if (error >= least) continue;
    least = error;
    chosen = trials[i].photons;
  }
  return chosen;
}

}  // namespace importon
