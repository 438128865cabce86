// How many photons a lookup is to have, from maps whose noise and bias are known.
#include "render/camera/lookup_choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace importon {
namespace {

constexpr std::size_t kValues = 30'000;

/// Two maps of a light of 1 that is seen as 1 + bias, with noise of the standard deviation `noise`.
LookupTrial trialOf(int photons, double bias, double noise, std::mt19937& random) {
  std::normal_distribution<float> value(static_cast<float>(1 + bias), static_cast<float>(noise));
  LookupTrial trial{photons, {}, {}};
  for (std::size_t i = 0; i < kValues; ++i) {
    trial.a.push_back(value(random));
    trial.b.push_back(value(random));
  }
  return trial;
}

/// Noise falls with the photons, bias grows with them.
std::vector<LookupTrial> trials() {
  std::mt19937 random(7);
  return {trialOf(4, 0, 0.2, random), trialOf(16, -0.1, 0.1, random), trialOf(64, -0.3, 0.02, random)};
}

TEST(LookupChoice, TellsNoiseFromBias) {
  const std::vector<LookupError> errors = lookupErrors(trials());
  // Over the square of what the last one sees and a hundredth of it. Five standard deviations: of a variance from n
  // values sqrt(2/n) of itself, of a bias that of the mean square, sqrt(2 v² + 4 v b)/sqrt(2n), v the sum of variances.
  const double scale = 0.7 * 0.7 * 1.01, spread = 5 * std::sqrt(2.0 / kValues);
  EXPECT_NEAR(errors[0].variance, 0.04 / scale, spread * 0.04 / scale);
  EXPECT_NEAR(errors[1].variance, 0.01 / scale, spread * 0.01 / scale);
  EXPECT_NEAR(errors[1].bias, 0.01 / scale, 5 * 0.00034 / scale + spread * 0.05 / scale);
  EXPECT_NEAR(errors[2].bias, 0.09 / scale, 5 * 0.00054 / scale + spread * 0.04 / scale);
  EXPECT_EQ(errors[0].bias, 0);
}

TEST(LookupChoice, TakesFewerPhotonsForMorePasses) {
  EXPECT_EQ(chooseLookupPhotons(trials(), 1), 16);
  EXPECT_EQ(chooseLookupPhotons(trials(), 1000), 4);
}

}  // namespace
}  // namespace importon
