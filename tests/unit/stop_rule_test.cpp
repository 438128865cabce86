#include "render/plan/stop_rule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace importon::stop_rule_test {
namespace {

RenderJob jobOf(std::optional<int> passes, std::optional<double> seconds, std::optional<double> error) {
  RenderJob job;
  job.passes = passes;
  job.seconds = seconds;
  job.error = error;
  return job;
}

/// What becomes of a render whose whole passes take `passSeconds`, estimates `estimateSeconds`, with error(passes).
struct Outcome {
  int passes = 0, estimates = 0;
  double seconds = 0;
  std::vector<int> parts;
};

template <class Error>
Outcome play(const RenderJob& job, int maxPasses, double passSeconds, double estimateSeconds, const Error& error) {
  StopRule rule(job, maxPasses, estimateSeconds);
  Outcome outcome;
  for (;;) {
    if (rule.wantsEstimate(outcome.passes)) {
      outcome.seconds += estimateSeconds;
      rule.errorIs(outcome.passes, error(outcome.passes), estimateSeconds);
      ++outcome.estimates;
    }
    const int parts = rule.partsOfNext(outcome.passes, outcome.seconds);
    if (parts == 0) return outcome;
    const double seconds = passSeconds * parts / kPartsOfPass;
    outcome.seconds += seconds;
    rule.passTook(seconds, parts);
    outcome.parts.push_back(parts);
    ++outcome.passes;
  }
}

double rootError(int passes) { return 0.4 / std::sqrt(passes); }

TEST(StopRule, MakesAsManyPassesAsAsked) {
  const Outcome outcome = play(jobOf(7, {}, {}), 7, 1, 1, rootError);
  EXPECT_EQ(outcome.passes, 7);
  EXPECT_EQ(outcome.estimates, 0);
}

// 0.4/sqrt(64) = 0.05.
TEST(StopRule, StopsAtTheErrorWithFewEstimates) {
  const Outcome outcome = play(jobOf({}, {}, 0.05), 1000, 1, 1, rootError);
  EXPECT_GE(outcome.passes, 64);
  EXPECT_LE(outcome.passes, 70);
  EXPECT_LE(outcome.estimates, 7);
}

TEST(StopRule, StopsAtTheErrorAndNotAbove) {
  const auto goesOnAt = [](double error) {
    StopRule rule(jobOf({}, {}, 0.05), 1000, 0);
    rule.errorIs(64, error, 0);
    return rule.partsOfNext(64, 0) > 0;
  };
  EXPECT_TRUE(goesOnAt(std::nextafter(0.05, 1)));
  EXPECT_FALSE(goesOnAt(0.05));
  EXPECT_FALSE(goesOnAt(0.049));
}

TEST(StopRule, HasADefaultTarget) {
  EXPECT_EQ(StopRule(jobOf({}, {}, {}), 64, 0).target(), kDefaultError);
  EXPECT_LT(StopRule(jobOf(5, {}, {}), 5, 0).target(), 0);
  EXPECT_LT(StopRule(jobOf({}, 5, {}), 5, 0).target(), 0);
}

// The first stop is at two passes in each half, and the halves must be equal.
TEST(StopRule, StopsOnlyWhereBothHalvesHoldEquallyMany) {
  EXPECT_EQ(play(jobOf({}, {}, 1), 1000, 1, 0, rootError).passes, 4);
  for (const double target : {0.1, 0.07, 0.03, 0.011}) {
    EXPECT_EQ(play(jobOf({}, {}, target), 100000, 1, 0.1, rootError).passes % 2, 0) << target;
  }
}

// What is left at the end is too short for a quarter of a pass, which is taken to need 0.325 of a whole one's time.
TEST(StopRule, KeepsATimeBudgetWithTheFinishCounted) {
  for (const double budget : {5.0, 20.0, 100.0}) {
    const Outcome outcome = play(jobOf({}, budget, {}), 1 << 20, 1.6, 0.5, rootError);
    const double end = outcome.seconds + 2 * 0.5;  // the estimate's length and the guess for writing
    EXPECT_LE(end, budget);
    EXPECT_GT(end, budget - 0.325 * 1.6 * 1.2 - 0.5);
  }
}

TEST(StopRule, BeginsWithSmallPassesInPairs) {
  const Outcome outcome = play(jobOf({}, {}, 0.05), 1000, 1, 0, rootError);
  EXPECT_EQ(std::vector<int>(outcome.parts.begin(), outcome.parts.begin() + 6), (std::vector<int>{1, 1, 2, 2, 4, 4}));
}

TEST(StopRule, CutsNoPassShortThatACheckpointFollows) {
  RenderJob job = jobOf({}, 18.6, {});
  job.checkpoint = "checkpoint";
  const Outcome outcome = play(job, 1 << 20, 3, 0, rootError);
  EXPECT_TRUE(std::is_sorted(outcome.parts.begin(), outcome.parts.end()));
  job.checkpoint.clear();
  const Outcome cut = play(job, 1 << 20, 3, 0, rootError);
  EXPECT_FALSE(std::is_sorted(cut.parts.begin(), cut.parts.end()));
}

TEST(StopRule, MakesWholePassesWhereTheyAreCounted) {
  EXPECT_EQ(play(jobOf(3, {}, {}), 3, 1, 0, rootError).parts, std::vector<int>(3, kPartsOfPass));
  RenderJob job = jobOf({}, 10, {});
  job.gather = 4;
  EXPECT_EQ(play(job, 1 << 20, 3, 0, rootError).parts, std::vector<int>(3, kPartsOfPass));
}

TEST(StopRule, MakesOnePassEvenWithoutTime) { EXPECT_EQ(play(jobOf({}, 0.1, {}), 1 << 20, 3, 1, rootError).passes, 1); }

TEST(StopRule, GivesUpAtTheMostPasses) { EXPECT_EQ(play(jobOf({}, {}, 1e-6), 50, 1, 1, rootError).passes, 50); }

TEST(StopRule, StopsAtWhicheverComesFirst) {
  EXPECT_LE(play(jobOf({}, 30, 1e-6), 1 << 20, 1, 0, rootError).seconds, 30);
  EXPECT_LE(play(jobOf({}, 1e6, 0.1), 1 << 20, 1, 0, rootError).passes, 20);
}

TEST(StopRule, EstimatesRarely) {
  const Outcome outcome = play(jobOf({}, {}, 0.01), 10000, 0.1, 2, rootError);
  EXPECT_GE(outcome.passes, 1600);
  EXPECT_LE(outcome.passes, 1760);
  EXPECT_LE(outcome.estimates, 12);
}

TEST(StopRule, DecidesWithoutAClock) {
  const auto job = jobOf({}, {}, 0.03);
  EXPECT_EQ(play(job, 1000, 1, 1, rootError).passes, play(job, 1000, 7, 0.1, rootError).passes);
}

TEST(StopRule, GoesOnAsIfNeverStopped) {
  StopRule first(jobOf({}, {}, 0.05), 1000, 0);
  for (const int passes : {4, 8, 16}) first.errorIs(passes, rootError(passes), 1);
  StopRule second(jobOf({}, {}, 0.05), 1000, 0);
  second.trend() = first.trend();
  for (int passes = 17; passes < 100; ++passes) EXPECT_EQ(first.wantsEstimate(passes), second.wantsEstimate(passes));
}

TEST(StopRule, TellsTheTimeLeft) {
  StopRule rule(jobOf({}, {}, 0.05), 1000, 0);
  rule.passTook(3);  // a second of which starts the kernels
  rule.passTook(2);
  rule.errorIs(16, 0.1, 0);
  rule.errorIs(32, 0.1 / std::sqrt(2), 0);  // 64 passes will be needed
  EXPECT_NEAR(rule.secondsLeft(32, 64), 64, 1e-6);
  StopRule timed(jobOf({}, 10, {}), 1 << 20, 0);
  timed.passTook(3);
  timed.passTook(2);
  EXPECT_NEAR(timed.secondsLeft(2, 4), 6, 1e-9);
}

}  // namespace
}  // namespace importon::stop_rule_test
